#include "bundle/reprojection.h"

#include "core/guard.h"

namespace ck {

Reprojection reproject(const ck_camera& camera, const Pose& pose, const Vector3& point,
                       const Vector2& pixel) {
  const Vector3 rotated = pose.rotation * point;
  const Vector3 in_camera = rotated + pose.translation;
  const Vector2 p = in_camera.head<2>() / in_camera.z();
  const Vector2 d = distort(camera, p);
  const Eigen::Matrix<double, 2, 3> slope = project_jacobian(camera, in_camera);

  Reprojection found;
  found.residual = Vector2(camera.fx * d.x() + camera.cx, camera.fy * d.y() + camera.cy) - pixel;
  for (int row = 0; row < 2; ++row) {
    found.by_pose.block<1, 3>(row, 0) = rotated.cross(slope.row(row).transpose()).transpose();
  }
  found.by_pose.rightCols<3>() = slope;
  found.by_point.noalias() = slope * pose.rotation;

  const double r2 = p.squaredNorm(), xy = 2 * p.x() * p.y();
  found.by_camera << d.x(), 1, 0, r2 * p.x(), r2 * r2 * p.x(), xy, r2 + 2 * p.x() * p.x(),
      camera.fy / camera.fx * d.y(), 0, 1, r2 * p.y(), r2 * r2 * p.y(), r2 + 2 * p.y() * p.y(), xy;
  found.by_camera.block<1, 4>(0, 3) *= camera.fx;
  found.by_camera.block<1, 4>(1, 3) *= camera.fy;
  return found;
}

}  // namespace ck

ck_status ck_reprojection_jacobians(const ck_camera* camera, const ck_pose* pose,
                                    const double* point, const double* pixel, double* residual,
                                    double* pose_jacobian, double* point_jacobian,
                                    double* camera_jacobian) {
  return ck::guarded([&] {
    using namespace ck;
    require(residual && pose_jacobian && point_jacobian && camera_jacobian && camera && pose &&
                point && pixel,
            "missing argument");
    const Reprojection found =
        reproject(*camera, pose_from(*pose), Eigen::Map<const Vector3>(point),
                  Eigen::Map<const Vector2>(pixel));
    Eigen::Map<Vector2>{residual} = found.residual;
    Eigen::Map<Eigen::Matrix<double, 2, kPoseSize, Eigen::RowMajor>>{pose_jacobian} = found.by_pose;
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>{point_jacobian} = found.by_point;
    Eigen::Map<Eigen::Matrix<double, 2, kCameraSize, Eigen::RowMajor>>{camera_jacobian} =
        found.by_camera;
  });
}
