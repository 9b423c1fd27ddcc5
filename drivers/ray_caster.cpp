// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace geomap::drivers {
namespace {

using Eigen::Vector3d;

constexpr float kNearest = 1e-4F;   // [m] along the optical axis
constexpr double kTouching = 1e-3;  // [m] before the point that is looked at
constexpr float kFar = 1e6F;        // [m]
constexpr int kBeside = 4;          // triangles in the list before and behind one

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
  std::vector<int> picked(view.triangle.size());
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
      picked[pixel] = hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(hit.primID);
    }
  }
  pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const Vector3d ray = camera.ray(u, v);
      const Vector3d direction = rotation * ray;
      const int triangle = settled(picked, camera, u, v, origin, direction);
      view.triangle[pixel] = triangle;
      view.depth.depth[pixel] = 0.0;
      view.depth.cosine[pixel] = 0.0F;
      if (triangle < 0) continue;
      // The ray's third component in the camera frame is 1, so its length is the depth.
      const double along = planes_[static_cast<std::size_t>(triangle)].head<3>().dot(direction);
      view.depth.depth[pixel] = depth_of(triangle, origin, direction);
      view.depth.cosine[pixel] = static_cast<float>(std::abs(along) / ray.norm());
    }
  }
}

double RayCaster::depth_of(int triangle, const Vector3d& origin, const Vector3d& direction) const {
  const Eigen::Vector4d& plane = planes_[static_cast<std::size_t>(triangle)];
  const double along = plane.head<3>().dot(direction);
  const double height = plane.head<3>().dot(origin) + plane.w();
  return along == 0.0 ? 0.0 : std::max(0.0, -height / along);
}

// Embree works in float, and beside an edge its choice depends on the processor: there, what
// neighbouring pixels see is tested once more in double.
int RayCaster::settled(const std::vector<int>& picked, const geometry::CameraModel& camera, int u,
                       int v, const Vector3d& origin, const Vector3d& direction) const {
  const int own = picked[static_cast<std::size_t>(v * camera.width + u)];
  std::array<int, 9> candidates{own};
  std::size_t count = 1;
  for (int j = std::max(0, v - 1); j <= std::min(camera.height - 1, v + 1); ++j) {
    for (int i = std::max(0, u - 1); i <= std::min(camera.width - 1, u + 1); ++i) {
      const int other = picked[static_cast<std::size_t>(j * camera.width + i)];
      const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(count);
      if (std::find(candidates.begin(), end, other) == end) candidates[count++] = other;
    }
  }
  if (count == 1) return own;
  int nearest = -1;
  double least = 0.0;
  bool is_open = false;
  const auto consider = [&](int triangle) {
    if (!is_inside(triangle, origin, direction)) return;
    const double depth = depth_of(triangle, origin, direction);
    const bool is_nearer = nearest < 0 || depth < least || (depth == least && triangle < nearest);
    if (depth <= kNearest || !is_nearer) return;
    nearest = triangle;
    least = depth;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const int seen = candidates[k];
    is_open |= seen < 0;
    if (seen < 0) continue;
    consider(seen);
    // On what is round, facets may be narrower than a pixel: those beside are the next in the list.
    const Scene::Triangle& triangle = scene_.triangles[static_cast<std::size_t>(seen)];
    if (scene_.surfaces[triangle.surface].face >= 0) continue;
    const int last = static_cast<int>(scene_.triangles.size()) - 1;
    for (int t = std::max(0, seen - kBeside); t <= std::min(last, seen + kBeside); ++t) {
      if (scene_.triangles[static_cast<std::size_t>(t)].surface == triangle.surface) consider(t);
    }
  }
  return nearest >= 0 || is_open ? nearest : own;
}

// Which side of its three edges the ray passes. An edge is looked at from the same end whichever of
// its two triangles asks, so that nothing falls between them.
bool RayCaster::is_inside(int triangle, const Vector3d& origin, const Vector3d& direction) const {
  const auto& corners = scene_.triangles[static_cast<std::size_t>(triangle)].vertices;
  int left = 0, right = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
    const Vector3d a = scene_.vertices[std::min(from, to)] - origin;
    const Vector3d b = scene_.vertices[std::max(from, to)] - origin;
    const double side = direction.dot(a.cross(b)) * (from < to ? 1.0 : -1.0);
    left += side > 0.0 ? 1 : 0;
    right += side < 0.0 ? 1 : 0;
  }
  return left == 0 || right == 0;
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
