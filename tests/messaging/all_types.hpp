// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "bot_core/image_metadata_t.hpp"
#include "bot_core/image_t.hpp"
#include "bot_core/images_t.hpp"
#include "bot_core/pose_t.hpp"
#include "bot_core/rigid_transform_t.hpp"
#include "geomap/absorbed_feature_t.hpp"
#include "geomap/camera_attitude_t.hpp"
#include "geomap/camera_t.hpp"
#include "geomap/counter_t.hpp"
#include "geomap/edit_t.hpp"
#include "geomap/edit_target_t.hpp"
#include "geomap/feature_state_t.hpp"
#include "geomap/health_t.hpp"
#include "geomap/idle_edit_t.hpp"
#include "geomap/keyframe_t.hpp"
#include "geomap/keyframe_update_t.hpp"
#include "geomap/map_contents_t.hpp"
#include "geomap/map_delta_t.hpp"
#include "geomap/map_edit_record_t.hpp"
#include "geomap/map_edit_reply_t.hpp"
#include "geomap/map_edit_t.hpp"
#include "geomap/map_event_t.hpp"
#include "geomap/map_feature_t.hpp"
#include "geomap/map_request_t.hpp"
#include "geomap/map_state_t.hpp"
#include "geomap/map_t.hpp"
#include "geomap/observation_id_t.hpp"
#include "geomap/plane_frame_t.hpp"
#include "geomap/plane_set_t.hpp"
#include "geomap/plane_t.hpp"
#include "geomap/point_map_update_t.hpp"
#include "geomap/point_t.hpp"
#include "geomap/polygon_part_t.hpp"
#include "geomap/polygon_t.hpp"
#include "geomap/pose_correction_t.hpp"
#include "geomap/rgbd_frame_t.hpp"
#include "geomap/ring_t.hpp"
#include "geomap/stage_latency_t.hpp"
#include "geomap/transform_t.hpp"
#include "geomap/veto_state_t.hpp"
#include "geomap/veto_t.hpp"
#include "kinect/depth_msg_t.hpp"
#include "kinect/frame_msg_t.hpp"
#include "kinect/image_msg_t.hpp"

namespace geomap::testing {

/// @brief Every type of lcmtypes/.
using AllTypes = ::testing::Types<
    bot_core::image_metadata_t, bot_core::image_t, bot_core::images_t, bot_core::pose_t,
    bot_core::rigid_transform_t, kinect::depth_msg_t, kinect::image_msg_t, kinect::frame_msg_t,
    absorbed_feature_t, camera_attitude_t, camera_t, counter_t, edit_t, edit_target_t,
    feature_state_t, health_t, idle_edit_t, keyframe_t, keyframe_update_t, map_contents_t,
    map_delta_t, map_edit_record_t, map_edit_reply_t, map_edit_t, map_event_t, map_feature_t,
    map_request_t, map_state_t, map_t, observation_id_t, plane_frame_t, plane_set_t, point_t,
    veto_state_t, veto_t, plane_t, point_map_update_t, polygon_part_t, polygon_t, pose_correction_t,
    rgbd_frame_t, ring_t, stage_latency_t, transform_t>;

}  // namespace geomap::testing
