#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "surface/points.h"

namespace ck::surface {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

using Device = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

/// An embree device for calls from several threads.
Device make_device();

/// A committed scene of one mesh; `filter` (may be null) sees every hit.
Scene make_scene(RTCDevice device, const StridedPoints& positions, const uint32_t* triangles,
                 size_t triangle_count, RTCFilterFunctionN filter);

}  // namespace ck::surface
