// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

constexpr float kNearest = 1e-4F;   // [m] along the optical axis
constexpr double kTouching = 1e-3;  // [m] before the point that is looked at
constexpr float kFar = 1e6F;        // [m]

void set_ray(RTCRay& ray, const Vector3d& origin, const Vector3d& direction, float near,
             float far) {
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = near;
  ray.tfar = far;
  ray.time = 0.0F;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
}

void resize(SceneView& view, const geometry::CameraModel& camera) {
  const auto size =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  view.depth.width = camera.width;
  view.depth.height = camera.height;
  view.depth.depth.resize(size);
  view.depth.cosine.resize(size);
  view.triangle.resize(size);
}

}  // namespace

struct RayCaster::Embree {
  // One thread: a simulator is one of several processes of a machine.
  Embree() : device(rtcNewDevice("threads=1")) {
    if (device == nullptr) throw std::runtime_error("the ray caster (Embree) cannot be started");
    scene = rtcNewScene(device);
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  RTCDevice device;
  RTCScene scene = nullptr;
};

RayCaster::RayCaster(const Scene& scene) : scene_(scene), embree_(std::make_unique<Embree>()) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               scene.vertices.size()));
  for (const Vector3d& vertex : scene.vertices) {
    for (int i = 0; i < 3; ++i) *vertices++ = static_cast<float>(vertex[i]);
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), scene.triangles.size()));
  for (const Scene::Triangle& triangle : scene.triangles) {
    for (const std::uint32_t vertex : triangle.vertices) *indices++ = vertex;
    const Vector3d& a = scene.vertices[triangle.vertices[0]];
    const Vector3d normal = (scene.vertices[triangle.vertices[1]] - a)
                                .cross(scene.vertices[triangle.vertices[2]] - a)
                                .normalized();
    planes_.emplace_back(normal.x(), normal.y(), normal.z(), -normal.dot(a));
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  // No pin-holes where triangles meet.
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(embree_->scene);
}

RayCaster::~RayCaster() = default;

void RayCaster::cast(const geometry::CameraModel& camera, const Eigen::Isometry3d& T_world_camera,
                     SceneView& view) const {
  resize(view, camera);
  const Vector3d origin = T_world_camera.translation();
  const Eigen::Matrix3d rotation = T_world_camera.linear();
  std::vector<RTCRayHit> row(static_cast<std::size_t>(camera.width));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      RTCRayHit& hit = row[static_cast<std::size_t>(u)];
      set_ray(hit.ray, origin, rotation * camera.ray(u, v), kNearest, kFar);
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect1M(embree_->scene, &context, row.data(), static_cast<unsigned>(row.size()),
                   sizeof(RTCRayHit));
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const RTCHit& hit = row[static_cast<std::size_t>(u)].hit;
      if (hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        view.triangle[pixel] = -1;
        view.depth.depth[pixel] = 0.0;
        view.depth.cosine[pixel] = 0.0F;
        continue;
      }
      // The ray's third component in the camera frame is 1, so its length is the depth.
      const Eigen::Vector4d& plane = planes_[hit.primID];
      const Vector3d ray = camera.ray(u, v);
      const double along = plane.head<3>().dot(rotation * ray);
      const double height = plane.head<3>().dot(origin) + plane.w();
      view.triangle[pixel] = static_cast<std::int32_t>(hit.primID);
      view.depth.depth[pixel] = along == 0.0 ? 0.0 : -height / along;
      view.depth.cosine[pixel] = static_cast<float>(std::abs(along) / ray.norm());
    }
  }
}

bool RayCaster::is_free(const Vector3d& from, const Vector3d& to) const {
  const Vector3d direction = to - from;
  const double length = direction.norm();
  if (length <= kTouching) return true;
  RTCRay ray;
  set_ray(ray, from, direction, kNearest, static_cast<float>(1.0 - kTouching / length));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar > 0.0F;  // minus infinity when something is in between
}

}  // namespace geomap::drivers
