#include "surface/ray_mesh.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>

#include "core/guard.h"

namespace ck::surface {

Device make_device() {
  Device device(rtcNewDevice("threads=1"));
  if (!device) throw std::runtime_error("embree could not be started");
  return device;
}

Scene make_scene(RTCDevice device, const StridedPoints& positions, const uint32_t* triangles,
                 size_t triangle_count, RTCFilterFunctionN filter) {
  require(std::all_of(triangles, triangles + 3 * triangle_count,
                      [&](uint32_t i) { return i < positions.count; }),
          "a triangle names a vertex that does not exist");
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), std::max<size_t>(1, positions.count)));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), std::max<size_t>(1, triangle_count)));
  if (!vertices || !indices) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (size_t i = 0; i < positions.count; ++i) {
    std::memcpy(vertices + 3 * i, positions[i], 3 * sizeof(float));
  }
  std::memcpy(indices, triangles, triangle_count * 3 * sizeof(uint32_t));
  if (filter) rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return scene;
}

}  // namespace ck::surface
