#include "surface/poisson/contour.h"

#include <algorithm>
#include <functional>

#include "core/parallel_sort.h"
#include "surface/poisson/field.h"
#include "surface/poisson/leaves.h"
#include "surface/poisson/marching_cubes.h"

namespace ck::poisson {

namespace {

/// Parts that a thread works on at a time. Chosen: they take some ten microseconds each.
constexpr size_t kBlock = 64;

/// Two leaves with the surface between them: the ids, the lower one first.
using LeafPair = uint64_t;

struct Vertex {
  LeafPair pair;
  std::array<float, 3> position;

  bool operator<(const Vertex& other) const { return pair < other.pair; }
};

/// The surface around the nodes of a brick: its vertices in ascending order.
struct Part {
  Uninitialized<Vertex> vertices;
  std::vector<std::array<LeafPair, 3>> triangles;
};

/// Removes repeated vertices of a sorted list.
void remove_repeated(Uninitialized<Vertex>& sorted) {
  const auto is_same = [](const Vertex& a, const Vertex& b) { return a.pair == b.pair; };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), is_same), sorted.end());
}

class BrickContour {
 public:
  BrickContour(const std::vector<Level>& levels, const Leaves& leaves, const CellBox& box,
               size_t level, size_t brick)
      : level_(levels[level]), leaves_(leaves), box_(box), l_(level), b_(brick) {}

  Part run() {
    for (int i = 0; i < kBrick; ++i) {
      if (!level_.nodes[b_][i] || !is_in_box(local_coordinates(i))) continue;
      if (!find_leaves(local_coordinates(i))) continue;
      for (const MarchingCubes::Triangle& t : MarchingCubes::shared().triangles(inside_)) add(t);
    }
    std::sort(part_.vertices.begin(), part_.vertices.end());
    remove_repeated(part_.vertices);
    return std::move(part_);
  }

 private:
  bool is_in_box(Coordinates node) const {
    const Coordinates brick = level_.bricks.coordinates(b_);
    for (size_t a = 0; a < 3; ++a) node[a] += kSide * brick[a];
    return box_.has_node(node, level_.depth);
  }

  /// Finds the leaves around a node; false if it is a node of finer leaves, too, if the surface
  /// does not pass between them, or if it leaves the cube there.
  bool find_leaves(const Coordinates& node) {
    const Coordinates low{node[0] - 1, node[1] - 1, node[2] - 1};
    std::array<std::pair<int32_t, size_t>, 8> cells;
    inside_ = 0;
    int missing = 0;
    for (int k = 0; k < 8; ++k) {
      const auto [brick, cell] = cells[k] = resolve(level_.bricks, b_, corner(low, k));
      if (brick < 0 || !level_.cells[brick][cell]) {
        missing |= 1 << k;
      } else if (leaves_.is_refined(l_, brick, cell)) {
        return false;
      } else if (leaves_.value(l_, brick, cell) < 0) {
        inside_ |= 1 << k;
      }
    }
    if (missing == 0 && (inside_ == 0 || inside_ == 255)) return false;
    const Coordinates first = level_.bricks.coordinates(b_);
    for (int k = 0; k < 8; ++k) {
      Leaf& leaf = corners_[k];
      if (!(missing >> k & 1)) {
        leaf = leaves_.leaf(l_, cells[k].first, cells[k].second);
        continue;
      }
      Coordinates cell = corner(low, k);
      for (size_t a = 0; a < 3; ++a) cell[a] += kSide * first[a];
      leaf = leaves_.leaf_around(l_, cell);
      if (leaf.id == 0) return false;
      if (leaf.value < 0) inside_ |= 1 << k;
    }
    return true;
  }

  void add(const MarchingCubes::Triangle& edges) {
    std::array<LeafPair, 3> t;
    for (size_t i = 0; i < 3; ++i) t[i] = add_vertex(corners_[edges[i][0]], corners_[edges[i][1]]);
    // Where corners coincide, so do vertices.
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) part_.triangles.push_back(t);
  }

  /// The vertex between two leaves, by linear interpolation; the same from all nodes.
  LeafPair add_vertex(const Leaf& a, const Leaf& b) {
    const Leaf &first = a.id < b.id ? a : b, &second = a.id < b.id ? b : a;
    const double t = first.value / (static_cast<double>(first.value) - second.value);
    Vertex vertex{static_cast<LeafPair>(first.id) << 32 | second.id, {}};
    for (size_t i = 0; i < 3; ++i) {
      vertex.position[i] =
          static_cast<float>(first.center[i] + t * (second.center[i] - first.center[i]));
    }
    part_.vertices.push_back(vertex);
    return vertex.pair;
  }

  const Level& level_;
  const Leaves& leaves_;
  const CellBox& box_;
  const size_t l_, b_;
  /// The leaves around the current node, and those of them inside the surface, as bits.
  std::array<Leaf, 8> corners_;
  int inside_ = 0;
  Part part_;
};

std::vector<Part> make_parts(const std::vector<Level>& levels, double value, const CellBox& box,
                             const ck_control* control) {
  const Leaves leaves(levels, value, control);
  std::vector<std::pair<size_t, size_t>> bricks;
  for (size_t l = 0; l < levels.size(); ++l) {
    for (size_t b = 0; b < levels[l].bricks.count(); ++b) {
      const Coordinates brick = levels[l].bricks.coordinates(b);
      if (box.touches(brick, levels[l].depth)) bricks.emplace_back(l, b);
    }
  }
  std::vector<Part> parts(bricks.size());
  parallel_for(control, bricks.size(), [&](size_t i) {
    parts[i] = BrickContour(levels, leaves, box, bricks[i].first, bricks[i].second).run();
  });
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [](const Part& part) { return part.triangles.empty(); }),
              parts.end());
  return parts;
}

size_t position(const Uninitialized<Vertex>& sorted, LeafPair pair) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), Vertex{pair, {}});
  return static_cast<size_t>(found - sorted.begin());
}

/// All vertices in ascending order. Parts that share a vertex agree on its position.
Uninitialized<Vertex> merged_vertices(const std::vector<Part>& parts, const ck_control* control) {
  std::vector<size_t> starts{0};
  for (const Part& part : parts) starts.push_back(starts.back() + part.vertices.size());
  Uninitialized<Vertex> vertices(starts.back());
  parallel_for_blocks(control, parts.size(), kBlock, [&](size_t i) {
    std::copy(parts[i].vertices.begin(), parts[i].vertices.end(),
              vertices.begin() + std::ptrdiff_t(starts[i]));
  });
  parallel_sort(vertices, std::less<>(), control);
  remove_repeated(vertices);
  return vertices;
}

}  // namespace

Contour contour(const std::vector<Level>& levels, double value, const CellBox& box,
                const ck_control* control) {
  const ProgressPart first(control, 0, 0.7), second(control, 0.7, 0.7), third(control, 0.7, 1);
  const std::vector<Part> parts = make_parts(levels, value, box, first.control());
  const Uninitialized<Vertex> vertices = merged_vertices(parts, second.control());
  std::vector<size_t> starts{0};
  for (const Part& part : parts) starts.push_back(starts.back() + part.triangles.size());
  Contour result;
  result.positions.resize(vertices.size());
  result.triangles.resize(starts.back());
  parallel_for_blocks(second.control(), vertices.size(), kBlock * kBlock,
                      [&](size_t v) { result.positions[v] = vertices[v].position; });
  parallel_for_blocks(third.control(), parts.size(), kBlock, [&](size_t i) {
    const Part& part = parts[i];
    std::vector<uint32_t> numbers;
    for (const Vertex& v : part.vertices) {
      numbers.push_back(static_cast<uint32_t>(position(vertices, v.pair)));
    }
    for (size_t t = 0; t < part.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        result.triangles[starts[i] + t][k] = numbers[position(part.vertices, part.triangles[t][k])];
      }
    }
  });
  return result;
}

}  // namespace ck::poisson
