#include <algorithm>
#include <cmath>

#include "core/median.h"
#include "core/parallel.h"
#include "surface/photo_refinement.h"

namespace ck::surface {
namespace {

/// Fractions of the median evidence: a vertex with less than the first is not moved; from the
/// second on its bending term has full weight. Chosen.
constexpr double kMinimumShare = 0.01, kGoodShare = 0.1;
/// Mean bending around a vertex, relative to the mean edge length, at which the smoothness weight
/// is halved: reduces smoothing at creases, but not at a single outlier. Chosen.
constexpr double kCrease = 0.02;
/// Largest displacement of a vertex per round, in pixel footprints. Chosen: the linearization holds
/// within a pixel.
constexpr float kMaximumStep = 0.5f;
/// Cosine of the largest rotation of a triangle's normal per round: 60°. Chosen.
constexpr float kMinimumCosine = 0.5f;
/// Largest number of iterations of conjugate gradients. Chosen.
constexpr int kIterations = 40;
/// Relative reduction of the squared preconditioned residual at which conjugate gradients stop.
/// Chosen.
constexpr double kReduction = 1e-6;
/// Diagonal element of the squared bending operator in the preconditioner. Limit: that of a regular
/// mesh is 1 + 1/6.
constexpr float kBendingDiagonal = 1.2f;
/// Units of parallel work. Chosen.
constexpr size_t kBlocks = 64;

/// Solves for the displacements along the normals that minimize the photometric differences plus
/// the bending energy: a sparse linear system, solved by conjugate gradients. Lengths are in pixel
/// footprints.
class System {
 public:
  System(const RefinedMesh& mesh, const VertexEvidence& evidence, float smoothness,
         const ck_control* control)
      : mesh_(mesh),
        control_{nullptr, nullptr, thread_count(control)},
        size_(mesh.positions.size()),
        is_movable(size_, 0),
        diagonal_(size_, 0),
        bending_(size_, 0),
        pull_(size_, 0),
        scratch_(size_, 0) {
    const double unit = evidence.footprint;
    const double median = median_evidence(evidence) * unit * unit;
    if (!(median > 0)) return;
    // The bending of a given shape decreases with the square of the edge length.
    const double relative = unit / mesh.mean_edge;
    const double weight = smoothness * median * relative * relative * relative * relative;
    const double crease = kCrease * mesh.mean_edge / unit;
    std::vector<float> heights(size_, 0), bend(size_, 0);
    for_all([&](size_t v) { heights[v] = static_cast<float>(bend_at(v) / unit); });
    for (size_t v = 0; v < size_; ++v) {
      const double slope2 = evidence.slope2[v] * unit * unit;
      if (mesh.is_border[v] || !(slope2 > kMinimumShare * median)) continue;
      is_movable[v] = 1;
      const double sharpness = mean_around(v, heights) / crease;
      const double part = std::min(1.0, slope2 / (kGoodShare * median));
      bending_[v] = static_cast<float>(weight * part / (1 + sharpness * sharpness));
      bend[v] = heights[v] * bending_[v];
      diagonal_[v] = static_cast<float>(slope2);
      pull_[v] = static_cast<float>(evidence.pull[v] * unit);
    }
    transpose(bend, &scratch_);
    for (size_t v = 0; v < size_; ++v) pull_[v] = is_movable[v] ? pull_[v] - scratch_[v] : 0;
  }

  /// Conjugate gradients with a diagonal preconditioner; sums are taken in vertex order.
  std::vector<float> solve(const ck_control* control) {
    std::vector<float> moves(size_, 0), rest = pull_, scaled(size_), image(size_);
    const auto precondition = [&] {
      for (size_t v = 0; v < size_; ++v) {
        scaled[v] = is_movable[v] ? rest[v] / (diagonal_[v] + kBendingDiagonal * bending_[v]) : 0;
      }
    };
    precondition();
    std::vector<float> direction = scaled;
    double size = product(rest, scaled);
    const double goal = kReduction * size;
    for (int k = 0; k < kIterations && size > goal; ++k) {
      step(control, 0);
      apply(direction, &image);
      const double length = product(direction, image);
      if (!(length > 0)) break;
      const auto factor = static_cast<float>(size / length);
      for (size_t v = 0; v < size_; ++v) {
        moves[v] += factor * direction[v];
        rest[v] -= factor * image[v];
      }
      precondition();
      const double next = product(rest, scaled);
      const auto carried = static_cast<float>(next / size);
      size = next;
      for (size_t v = 0; v < size_; ++v) direction[v] = scaled[v] + carried * direction[v];
    }
    return moves;
  }

 private:
  const RefinedMesh& mesh_;
  const ck_control control_;
  const size_t size_;

 public:
  std::vector<uint8_t> is_movable;

 private:
  /// The median of the positive evidence; 0 if there is none.
  static double median_evidence(const VertexEvidence& evidence) {
    std::vector<double> some;
    for (double value : evidence.slope2) {
      if (value > 0) some.push_back(value);
    }
    return some.empty() ? 0 : median(some);
  }

  /// The height of the mean of its neighbors above a vertex, along the normal.
  double bend_at(size_t v) const {
    Vec3 sum;
    const uint32_t first = mesh_.offsets[v], end = mesh_.offsets[v + 1];
    if (first == end) return 0;
    for (uint32_t k = first; k < end; ++k) {
      sum += mesh_.positions[mesh_.neighbors[k]] - mesh_.positions[v];
    }
    return dot(mesh_.normals[v], sum) / static_cast<float>(end - first);
  }

  /// The mean over a vertex and its neighbors.
  double mean_around(size_t v, const std::vector<float>& values) const {
    double sum = values[v];
    const uint32_t first = mesh_.offsets[v], end = mesh_.offsets[v + 1];
    for (uint32_t k = first; k < end; ++k) sum += values[mesh_.neighbors[k]];
    return sum / (1 + static_cast<double>(end - first));
  }

  /// Calls `body(v)` for all vertices.
  template <typename Body>
  void for_all(Body&& body) const {
    parallel_for(&control_, kBlocks, [&](size_t block) {
      const size_t end = size_ * (block + 1) / kBlocks;
      for (size_t v = size_ * block / kBlocks; v < end; ++v) body(v);
    });
  }

  /// The change of the weighted bending under the given displacements.
  void bend(const std::vector<float>& moves, std::vector<float>* result) const {
    for_all([&](size_t v) {
      (*result)[v] = 0;
      const uint32_t first = mesh_.offsets[v], end = mesh_.offsets[v + 1];
      if (bending_[v] == 0 || first == end) return;
      float sum = 0;
      for (uint32_t k = first; k < end; ++k) {
        const uint32_t n = mesh_.neighbors[k];
        sum += moves[n] * dot(mesh_.normals[v], mesh_.normals[n]);
      }
      (*result)[v] = bending_[v] * (sum / static_cast<float>(end - first) - moves[v]);
    });
  }

  /// Applies the transpose of the unweighted bending operator.
  void transpose(const std::vector<float>& bends, std::vector<float>* result) const {
    for_all([&](size_t v) {
      float sum = -bends[v];
      for (uint32_t k = mesh_.offsets[v]; k < mesh_.offsets[v + 1]; ++k) {
        const uint32_t n = mesh_.neighbors[k];
        const auto count = static_cast<float>(mesh_.offsets[n + 1] - mesh_.offsets[n]);
        sum += bends[n] * dot(mesh_.normals[v], mesh_.normals[n]) / count;
      }
      (*result)[v] = sum;
    });
  }

  /// Multiplies by the system matrix.
  void apply(const std::vector<float>& moves, std::vector<float>* result) {
    bend(moves, &scratch_);
    transpose(scratch_, result);
    for (size_t v = 0; v < size_; ++v) {
      (*result)[v] = is_movable[v] ? (*result)[v] + diagonal_[v] * moves[v] : 0;
    }
  }

  static double product(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
    return sum;
  }

  std::vector<float> diagonal_, bending_, pull_, scratch_;
};

/// Moves vertices along their normals without flipping triangles.
class Move {
 public:
  Move(const std::vector<float>& lengths, RefinedMesh* mesh)
      : mesh_(*mesh), before_(mesh->positions), lengths_(lengths) {
    for (const auto& t : mesh_.triangles) {
      initial_normals_.push_back(normalized(mesh_.doubled_area(t)));
    }
    for (uint32_t v = 0; v < lengths_.size(); ++v) place(v);
  }

  /// Gives the corners of triangles that rotate too far the same displacement, because the
  /// triangles are narrow; those that still rotate too far are not moved.
  void limit_rotations() {
    for (int pass = 0; pass < kPasses; ++pass) {
      for_rotated([&](const std::array<uint32_t, 3>& t) {
        const float mean = (lengths_[t[0]] + lengths_[t[1]] + lengths_[t[2]]) / 3;
        // Fixed vertices have displacement 0 and keep it.
        for (uint32_t v : t) set(v, lengths_[v] == 0 ? 0 : mean);
      });
    }
    for (bool changes = true; changes;) {
      changes = false;
      for_rotated([&](const std::array<uint32_t, 3>& t) {
        for (uint32_t v : t) {
          changes = changes || lengths_[v] != 0;
          set(v, 0);
        }
      });
    }
  }

 private:
  /// Passes in which the displacements of rotated triangles are averaged. Chosen.
  static constexpr int kPasses = 8;

  /// Calls `body(triangle)` for the triangles that rotate too far.
  template <typename Body>
  void for_rotated(Body&& body) {
    for (size_t t = 0; t < initial_normals_.size(); ++t) {
      const auto& triangle = mesh_.triangles[t];
      const Vec3 now = normalized(mesh_.doubled_area(triangle));
      if (dot(now, initial_normals_[t]) < kMinimumCosine) body(triangle);
    }
  }

  void set(uint32_t v, float length) {
    lengths_[v] = length;
    place(v);
  }

  void place(uint32_t v) { mesh_.positions[v] = before_[v] + mesh_.normals[v] * lengths_[v]; }

  RefinedMesh& mesh_;
  const std::vector<Vec3> before_;
  std::vector<float> lengths_;
  std::vector<Vec3> initial_normals_;
};

}  // namespace

std::vector<uint8_t> move_vertices(const VertexEvidence& evidence, float smoothness,
                                   const ck_control* control, RefinedMesh* mesh) {
  System system(*mesh, evidence, smoothness, control);
  auto lengths = system.solve(control);
  for (size_t v = 0; v < lengths.size(); ++v) {
    const float move = std::clamp(lengths[v], -kMaximumStep, kMaximumStep);
    lengths[v] = system.is_movable[v] ? move * static_cast<float>(evidence.footprint) : 0;
  }
  Move(lengths, mesh).limit_rotations();
  return system.is_movable;
}

}  // namespace ck::surface
