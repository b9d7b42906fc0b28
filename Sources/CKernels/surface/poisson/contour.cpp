#include "surface/poisson/contour.h"

#include <algorithm>

#include "surface/poisson/field.h"
#include "surface/poisson/leaves.h"
#include "surface/poisson/marching_cubes.h"

namespace ck::poisson {

namespace {

/// Two leaves with the surface between them: the ids, the lower one first.
using LeafPair = uint64_t;

/// The surface around the nodes of a brick.
struct Part {
  /// The vertices in ascending order, and their positions.
  std::vector<LeafPair> vertices;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<LeafPair, 3>> triangles;
};

class BrickContour {
 public:
  BrickContour(const std::vector<Level>& levels, const Leaves& leaves, size_t level, size_t brick)
      : level_(levels[level]), leaves_(leaves), l_(level), b_(brick) {}

  Part run() {
    for (int i = 0; i < kBrick; ++i) {
      if (!level_.nodes[b_][i] || !find_leaves(local_coordinates(i))) continue;
      for (const MarchingCubes::Triangle& t : MarchingCubes::shared().triangles(inside_)) add(t);
    }
    sort_vertices();
    return std::move(part_);
  }

 private:
  struct Vertex {
    LeafPair pair;
    std::array<float, 3> position;
  };

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
    vertices_.push_back(vertex);
    return vertex.pair;
  }

  void sort_vertices() {
    std::sort(vertices_.begin(), vertices_.end(),
              [](const Vertex& a, const Vertex& b) { return a.pair < b.pair; });
    for (const Vertex& v : vertices_) {
      if (!part_.vertices.empty() && part_.vertices.back() == v.pair) continue;
      part_.vertices.push_back(v.pair);
      part_.positions.push_back(v.position);
    }
  }

  const Level& level_;
  const Leaves& leaves_;
  const size_t l_, b_;
  /// The leaves around the current node, and those of them inside the surface, as bits.
  std::array<Leaf, 8> corners_;
  int inside_ = 0;
  std::vector<Vertex> vertices_;
  Part part_;
};

std::vector<Part> make_parts(const std::vector<Level>& levels, double value,
                             const ck_control* control) {
  const Leaves leaves(levels, value, control);
  std::vector<std::pair<size_t, size_t>> bricks;
  for (size_t l = 0; l < levels.size(); ++l) {
    for (size_t b = 0; b < levels[l].bricks.count(); ++b) bricks.emplace_back(l, b);
  }
  std::vector<Part> parts(bricks.size());
  parallel_for(control, bricks.size(), [&](size_t i) {
    parts[i] = BrickContour(levels, leaves, bricks[i].first, bricks[i].second).run();
  });
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                             [](const Part& part) { return part.triangles.empty(); }),
              parts.end());
  return parts;
}

size_t position(const std::vector<LeafPair>& sorted, LeafPair pair) {
  return static_cast<size_t>(std::lower_bound(sorted.begin(), sorted.end(), pair) - sorted.begin());
}

}  // namespace

Contour contour(const std::vector<Level>& levels, double value, const ck_control* control) {
  const ProgressPart first(control, 0, 0.7), second(control, 0.7, 1);
  const std::vector<Part> parts = make_parts(levels, value, first.control());
  std::vector<LeafPair> vertices;
  std::vector<size_t> starts{0};
  for (const Part& part : parts) {
    vertices.insert(vertices.end(), part.vertices.begin(), part.vertices.end());
    starts.push_back(starts.back() + part.triangles.size());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Contour result;
  result.positions.resize(vertices.size());
  result.triangles.resize(starts.back());
  std::vector<std::vector<uint32_t>> numbers(parts.size());
  parallel_for(second.control(), parts.size(), [&](size_t i) {
    const Part& part = parts[i];
    for (LeafPair v : part.vertices) {
      numbers[i].push_back(static_cast<uint32_t>(position(vertices, v)));
    }
    for (size_t t = 0; t < part.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        result.triangles[starts[i] + t][k] =
            numbers[i][position(part.vertices, part.triangles[t][k])];
      }
    }
  });
  // Parts that share a vertex agree on its position.
  for (size_t i = 0; i < parts.size(); ++i) {
    for (size_t v = 0; v < numbers[i].size(); ++v) {
      result.positions[numbers[i][v]] = parts[i].positions[v];
    }
  }
  return result;
}

}  // namespace ck::poisson
