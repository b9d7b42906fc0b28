#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "ck_surface.h"
#include "core/guard.h"
#include "core/span.h"

struct ck_surface {
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> densities;
  std::vector<Eigen::Vector3i> triangles;
};

namespace {

/// State shared by the solver's thread and its caller, freed by the one that ends last.
struct Job {
  open3d::geometry::PointCloud cloud;
  ck_poisson_options options;
  ck_surface surface;
  std::exception_ptr error;
  bool done = false;
  /// Whether the caller was canceled and no longer waits.
  bool is_abandoned = false;
  std::mutex mutex;
  std::condition_variable finished;
};

/// Interval at which progress is reported and cancellation takes effect.
constexpr std::chrono::milliseconds kPollingInterval(50);

/// The abandoned solvers of the process. Each still occupies memory and a processor core, which are
/// not available to the next one.
class AbandonedSolvers {
 public:
  /// Never destroyed: a solver may outlive static objects.
  static AbandonedSolvers& shared() {
    static auto& solvers = *new AbandonedSolvers;
    return solvers;
  }

  void add() {
    std::lock_guard<std::mutex> lock(mutex_);
    ++count_;
  }

  void remove() {
    std::lock_guard<std::mutex> lock(mutex_);
    --count_;
    ended_.notify_all();
  }

  /// Waits until there are none; throws `Canceled` when the caller cancels.
  void await_end(const ck_control* control) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (count_ > 0) {
      ended_.wait_for(lock, kPollingInterval);
      lock.unlock();
      ck::step(control, 0);
      lock.lock();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  int count_ = 0;
};

void solve(Job& job) {
  // With several threads the accumulation order, and therefore the surface, would differ between
  // runs.
  const int threads = 1;
  auto [mesh, densities] = open3d::geometry::TriangleMesh::CreateFromPointCloudPoisson(
      job.cloud, static_cast<size_t>(job.options.depth), 0, static_cast<float>(job.options.scale),
      false, threads);
  job.surface.positions = std::move(mesh->vertices_);
  job.surface.triangles = std::move(mesh->triangles_);
  job.surface.densities = std::move(densities);
}

void run(const std::shared_ptr<Job>& job) {
  std::exception_ptr error;
  try {
    solve(*job);
  } catch (...) {
    error = std::current_exception();
  }
  std::lock_guard<std::mutex> lock(job->mutex);
  job->error = error;
  job->done = true;
  job->finished.notify_all();
  if (!job->is_abandoned) return;
  job->cloud.Clear();
  job->surface = ck_surface();
  AbandonedSolvers::shared().remove();
}

/// Model of the solver's duration: seconds for 100,000 points at this octree depth, the factor per
/// further level, and the exponent of the number of points. Results do not depend on it.
constexpr double kReferenceSeconds = 3.4, kFactorPerLevel = 2.4, kPointExponent = 0.25;
constexpr int kReferenceDepth = 8;

/// Estimated progress of the solver, which reports none: linear in the expected duration up to 80
/// %, then asymptotically approaching 1.
double fraction(double seconds, int depth, size_t points) {
  const double expected = kReferenceSeconds * std::pow(kFactorPerLevel, depth - kReferenceDepth) *
                          std::pow(1e-5 * static_cast<double>(points), kPointExponent);
  const double share = seconds / expected;
  return share < 0.8 ? share : 1 - 0.2 * std::exp(4 - 5 * share);
}

/// Waits for the job and reports progress.
///
/// On cancellation detaches the worker: Open3D's solver has no callback in which it could be
/// stopped. The job keeps the points and the solver's memory until the worker ends; later jobs
/// start after that.
void await(Job& job, std::thread& worker, const ck_control* control) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock<std::mutex> lock(job.mutex);
  while (!job.done) {
    job.finished.wait_for(lock, kPollingInterval);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    try {
      ck::step(control, fraction(elapsed.count(), job.options.depth, job.cloud.points_.size()));
    } catch (...) {
      job.is_abandoned = !job.done;
      if (job.is_abandoned) AbandonedSolvers::shared().add();
      worker.detach();
      throw;
    }
  }
  lock.unlock();
  worker.join();
}

}  // namespace

ck_status ck_poisson(ck_span positions, ck_span normals, const ck_poisson_options* options,
                     const ck_control* control, ck_surface** surface) {
  return ck::guarded([&] {
    ck::require(positions.data && normals.data && options && surface, "null pointer");
    ck::require(positions.count == normals.count, "as many normals as positions are needed");
    ck::require(options->depth >= 2 && options->depth <= 14, "depth must be 2 to 14");
    ck::require(options->scale >= 1, "scale must be 1 or more");
    auto job = std::make_shared<Job>();
    job->options = *options;
    const ck::Strided<float> p(positions), n(normals);
    for (size_t i = 0; i < p.count; ++i) {
      if (!p.is_finite(i) || !n.is_finite(i)) continue;
      const Eigen::Vector3d normal(n[i][0], n[i][1], n[i][2]);
      if (!(normal.squaredNorm() > 0)) continue;
      job->cloud.points_.emplace_back(p[i][0], p[i][1], p[i][2]);
      job->cloud.normals_.push_back(normal.normalized());
    }
    if (job->cloud.points_.size() < 4) throw ck::Degenerate("fewer than four oriented points");
    AbandonedSolvers::shared().await_end(control);
    ck::step(control, 0);
    std::thread worker([job] { run(job); });
    await(*job, worker, control);
    if (job->error) std::rethrow_exception(job->error);
    *surface = new ck_surface(std::move(job->surface));
  });
}

size_t ck_surface_vertex_count(const ck_surface* surface) { return surface->positions.size(); }

size_t ck_surface_triangle_count(const ck_surface* surface) { return surface->triangles.size(); }

void ck_surface_copy(const ck_surface* surface, ck_mutable_span positions, float* densities,
                     uint32_t* triangles) {
  for (size_t i = 0; i < surface->positions.size(); ++i) {
    const Eigen::Vector3f p = surface->positions[i].cast<float>();
    std::memcpy(ck::MutableStrided<float>(positions)[i], p.data(), 3 * sizeof(float));
    densities[i] = static_cast<float>(surface->densities[i]);
  }
  for (size_t i = 0; i < surface->triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      triangles[3 * i + k] = static_cast<uint32_t>(surface->triangles[i][k]);
    }
  }
}

void ck_surface_free(ck_surface* surface) { delete surface; }
