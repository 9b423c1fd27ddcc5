// SPDX-License-Identifier: BSD-3-Clause
#include "perception/keyframe_journal.hpp"

#include <gtest/gtest.h>

#include "messaging/convert_frame.hpp"
#include "messaging/temporary_folder.hpp"
#include "perception/point_map_checks.hpp"
#include "support/plane_renderer.hpp"

namespace geomap::perception {
namespace {

constexpr std::int64_t kStart = 1'000'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

TrackerConfig by_known_poses() {
  TrackerConfig config;
  config.prior.kind = "localisation";
  return config;
}

// A camera that moves through a room, and what was kept of it.
class Drive {
 public:
  explicit Drive(const std::filesystem::path& folder)
      : journal_(folder), tracking_(by_known_poses(), [this](const TrackedFrame& frame) {
          if (frame.tracked.status == TrackStatus::kKeyframe) journal_.keep(frame, tracker());
        }) {
    journal_.restore(tracker());
  }

  void see(int count) {
    for (int i = 0; i < count; ++i, ++seen_) {
      const std::int64_t utime = kStart + seen_ * kSecond;
      const Eigen::Isometry3d T_world_camera =
          testing::look_at({-1.31 + 0.13 * seen_, -0.87 + 0.07 * seen_, 1.23}, {0.7, 0.6, 0.5});
      geometry::RgbdFrame frame =
          testing::render(testing::small_room(), testing::kinect_camera(2), T_world_camera, 0.004,
                          static_cast<unsigned>(seen_))
              .frame;
      frame.utime = utime;
      tracking_.add_camera_to_body(utime, Eigen::Isometry3d::Identity());
      tracking_.add_pose(utime, T_world_camera);
      tracking_.add_frame(messaging::to_message(frame));
    }
    tracking_.finish();
  }
  void drop(std::int64_t keyframe) {
    ASSERT_TRUE(tracker().remove(keyframe));
    geomap::keyframe_update_t update{};
    update.removed = {keyframe};
    update.n_removed = 1;
    journal_.keep(update);
  }
  /// As when the operator has one dropped, and then undoes that.
  void drop_and_put_back(std::int64_t keyframe) {
    ASSERT_TRUE(tracker().remove(keyframe));
    ASSERT_FALSE(tracker().remove(keyframe));
    ASSERT_TRUE(tracker().put_back(keyframe));
    ASSERT_FALSE(tracker().put_back(keyframe));
    geomap::keyframe_update_t dropped{}, restored{};
    dropped.dropped = restored.restored = {keyframe};
    dropped.n_dropped = restored.n_restored = 1;
    journal_.keep(dropped);
    journal_.keep(restored);
  }
  void clear() {
    tracker().clear();
    journal_.clear();
  }
  Tracker& tracker() { return tracking_.tracker(); }

 private:
  KeyframeJournal journal_;
  TrackingProcess tracking_;
  int seen_ = 0;
};

using KeyframeJournalTest = testing::TemporaryFolder;

TEST_F(KeyframeJournalTest, ARestoredTrackerHasTheSamePointMapToTheLastBit) {
  const std::filesystem::path folder = path("state");
  Drive drive(folder);
  drive.see(6);
  ASSERT_EQ(drive.tracker().point_map().keyframes(), 6u);
  drive.drop(kStart + 2 * kSecond);

  Tracker restored(by_known_poses());
  const auto found = KeyframeJournal(folder).restore(restored);
  EXPECT_EQ(found.keyframes, 5u);
  EXPECT_EQ(found.refused, 0u);
  testing::expect_same(restored.point_map(), drive.tracker().point_map());
}

TEST_F(KeyframeJournalTest, AKeyFrameThatIsPutBackLeavesNoTrace) {
  Drive plain(path("plain")), mended(path("mended"));
  plain.see(5);
  mended.see(3);
  mended.drop_and_put_back(kStart + kSecond);
  mended.see(2);
  testing::expect_same(mended.tracker().point_map(), plain.tracker().point_map());

  Tracker restored(by_known_poses());
  EXPECT_EQ(KeyframeJournal(path("mended")).restore(restored).keyframes, 5u);
  testing::expect_same(restored.point_map(), plain.tracker().point_map());
}

TEST_F(KeyframeJournalTest, ACutLastRecordCostsThatOneAlone) {
  const std::filesystem::path folder = path("state");
  Drive(folder).see(4);
  const auto file = folder / "keyframes.lcmlog";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1000);
  Tracker restored(by_known_poses());
  const auto found = KeyframeJournal(folder).restore(restored);
  EXPECT_EQ(found.keyframes, 3u);
  EXPECT_GT(found.refused, 0u);
}

TEST_F(KeyframeJournalTest, WhatWasClearedDoesNotComeBack) {
  const std::filesystem::path folder = path("state");
  Drive drive(folder);
  drive.see(3);
  drive.clear();
  Tracker restored(by_known_poses());
  EXPECT_EQ(KeyframeJournal(folder).restore(restored).keyframes, 0u);
}

}  // namespace
}  // namespace geomap::perception
