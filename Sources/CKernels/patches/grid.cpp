#include "patches/grid.h"

namespace ck::patches {

void Grid::read(const ck_patch* patches) {
  for (size_t i = 0; i < planes.size(); ++i) {
    const ck_patch& p = patches[i];
    planes[i] = {p.inverse_depth, p.gradient_x, p.gradient_y};
    costs[i] = p.cost;
  }
}

void Grid::write(ck_patch* patches) const {
  for (size_t i = 0; i < planes.size(); ++i) {
    const Plane& p = planes[i];
    const bool is_set = p.w > 0 && costs[i] < kNoPatch;
    patches[i] = is_set ? ck_patch{p.w, p.gx, p.gy, costs[i]} : ck_patch{0, 0, 0, kNoPatch};
  }
}

}  // namespace ck::patches
