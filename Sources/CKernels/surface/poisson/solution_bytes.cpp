#include "surface/poisson/solution_bytes.h"

#include <cstring>
#include <type_traits>

#include "core/guard.h"

namespace ck::poisson {

namespace {

static_assert(std::is_trivially_copyable_v<Mask> && sizeof(Mask) == kBrick / 8);

/// Limit: bytes of a brick: its code, its cells and nodes, and their values.
constexpr size_t kBrickBytes = 8 + 2 * sizeof(Mask) + kBrick * sizeof(float);

/// Limit: the cells around a node have corners one node away.
constexpr int kReach = 1;

class Writer {
 public:
  template <typename Value>
  void add(const Value* values, size_t count) {
    const size_t size = count * sizeof(Value), start = bytes_.size();
    bytes_.resize(start + size);
    if (size > 0) std::memcpy(bytes_.data() + start, values, size);
  }
  void add(uint64_t value) { add(&value, 1); }
  std::vector<uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

class Reader {
 public:
  Reader(const uint8_t* bytes, size_t count) : next_(bytes), left_(count) {}

  template <typename Value>
  void read(Value* values, size_t count) {
    const size_t size = count * sizeof(Value);
    skip(size);
    if (size > 0) std::memcpy(static_cast<void*>(values), next_ - size, size);
  }
  uint64_t number() {
    uint64_t value;
    read(&value, 1);
    return value;
  }
  void skip(size_t size) {
    require(size <= left_, "malformed bytes of a surface");
    next_ += size;
    left_ -= size;
  }
  size_t left() const { return left_; }

 private:
  const uint8_t* next_;
  size_t left_;
};

void write(const Level& level, const CellBox& box, Writer& writer) {
  std::vector<size_t> bricks;
  for (size_t b = 0; b < level.bricks.count(); ++b) {
    if (box.touches(level.bricks.coordinates(b), level.depth, kReach)) bricks.push_back(b);
  }
  writer.add(bricks.size());
  for (size_t b : bricks) {
    writer.add(level.bricks.code(b));
    writer.add(&level.cells[b], 1);
    writer.add(&level.nodes[b], 1);
    writer.add(level.values.data() + b * kBrick, kBrick);
  }
}

Level read_level(int depth, const CellBox& box, Reader& reader, const ck_control* control) {
  Level level;
  level.depth = depth;
  const uint64_t count = reader.number();
  require(count <= reader.left() / kBrickBytes, "malformed bytes of a surface");
  std::vector<uint64_t> codes;
  uint64_t least = 0;
  for (uint64_t b = 0; b < count; ++b) {
    const uint64_t code = reader.number();
    require(code >= least, "malformed bytes of a surface");
    least = code + 1;
    if (!box.touches(from_morton(code), depth, kReach)) {
      reader.skip(kBrickBytes - 8);
      continue;
    }
    codes.push_back(code);
    reader.read(&level.cells.emplace_back(), 1);
    reader.read(&level.nodes.emplace_back(), 1);
    level.values.resize(codes.size() * kBrick);
    reader.read(level.values.data() + (codes.size() - 1) * kBrick, kBrick);
  }
  level.bricks = BrickSet(std::move(codes), control);
  drop_incomplete_cells(level, control);
  return level;
}

}  // namespace

std::vector<uint8_t> encoded(const Solution& solution, const CellBox& box) {
  Writer writer;
  writer.add(solution.cube.origin.data(), 3);
  writer.add(&solution.cube.side, 1);
  writer.add(&solution.value, 1);
  writer.add(solution.levels.size());
  for (const Level& level : solution.levels) write(level, box, writer);
  return writer.take();
}

Solution decoded(const uint8_t* bytes, size_t count, const CellBox& box,
                 const ck_control* control) {
  Reader reader(bytes, count);
  Solution result;
  reader.read(result.cube.origin.data(), 3);
  reader.read(&result.cube.side, 1);
  reader.read(&result.value, 1);
  const uint64_t levels = reader.number();
  require(levels <= kCodeDepth - kFirstDepth, "malformed bytes of a surface");
  for (uint64_t l = 0; l < levels; ++l) {
    Level level = read_level(kFirstDepth + static_cast<int>(l), box, reader, control);
    if (l > 0) find_parents(level, result.levels.back(), control);
    result.levels.push_back(std::move(level));
  }
  require(reader.left() == 0, "malformed bytes of a surface");
  return result;
}

}  // namespace ck::poisson
