// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace geomap::messaging::channels {

// Input: cameras and robot.
inline constexpr const char* kRgbdFrame = "RGBD_FRAME";            // geomap.rgbd_frame_t
inline constexpr const char* kOpenniFrame = "OPENNI_FRAME";        // bot_core.images_t
inline constexpr const char* kKinectFrame = "KINECT_FRAME";        // kinect.frame_msg_t
inline constexpr const char* kCameraAttitude = "CAMERA_ATTITUDE";  // geomap.camera_attitude_t
inline constexpr const char* kPose = "POSE";  // bot_core.pose_t: T_odom_body or T_world_body
inline constexpr const char* kCameraToBody =
    "CAMERA_TO_BODY";  // bot_core.rigid_transform_t: T_body_camera
inline constexpr const char* kTruthPose =
    "TRUTH_POSE";  // bot_core.rigid_transform_t: T_world_camera

// Registration.
inline constexpr const char* kKeyframe = "KEYFRAME";               // geomap.keyframe_t
inline constexpr const char* kKeyframeUpdate = "KEYFRAME_UPDATE";  // geomap.keyframe_update_t
inline constexpr const char* kCameraPose =
    "CAMERA_POSE";  // bot_core.rigid_transform_t: T_world_camera
inline constexpr const char* kOdomToWorld =
    "ODOM_TO_WORLD";                                   // bot_core.rigid_transform_t: T_world_odom
inline constexpr const char* kPointMap = "POINT_MAP";  // geomap.point_map_update_t

// Plane extraction.
inline constexpr const char* kPlanes = "PLANES";  // geomap.plane_set_t

// Mapping and the operator.
inline constexpr const char* kMapDelta = "MAP_DELTA";           // geomap.map_delta_t
inline constexpr const char* kMapSnapshot = "MAP_SNAPSHOT";     // geomap.map_t
inline constexpr const char* kMapEdit = "MAP_EDIT";             // geomap.map_edit_t
inline constexpr const char* kMapEditReply = "MAP_EDIT_REPLY";  // geomap.map_edit_reply_t
inline constexpr const char* kMapEditRecord =
    "MAP_EDIT_RECORD";  // geomap.map_edit_record_t: the history of edits
inline constexpr const char* kMapRequest = "MAP_REQUEST";  // geomap.map_request_t

// Files: the exact state of a map, and the journal of its events.
inline constexpr const char* kMapState = "MAP_STATE";  // geomap.map_state_t
inline constexpr const char* kMapEvent = "MAP_EVENT";  // geomap.map_event_t

// Every process.
inline constexpr const char* kHealth = "HEALTH";  // geomap.health_t

}  // namespace geomap::messaging::channels
