// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/camera_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>
#include <vector>

#include "drivers/frame_source.hpp"

namespace geomap::drivers {
namespace {

using std::chrono::milliseconds;

/// A camera whose images a test makes.
class FakeCamera : public RgbdCamera {
 public:
  using Read = std::function<std::optional<CameraImage>()>;
  FakeCamera(Read read, int images) : read_(std::move(read)), images_(images) {}

  const CameraDescription& description() const override { return description_; }
  std::optional<CameraImage> read(milliseconds) override {
    ++reads_;
    return read_();
  }
  bool has_ended() const override { return reads_ == images_; }
  CameraLosses losses() const override { return {.torn = reads_, .missed = 2 * reads_}; }

 private:
  CameraDescription description_{.name = "fake", .depth = {}, .color = {}};
  Read read_;
  int images_;
  int reads_ = 0;
};

CameraThread::Open open_fake(FakeCamera::Read read, int images = -1) {
  return [=] { return std::make_unique<FakeCamera>(read, images); };
}

CameraImage depth(std::int64_t time) { return {time, geometry::DepthImage{1, 1, {1}}}; }
CameraImage color(std::int64_t time) { return {time, geometry::ColorImage{1, 1, {1, 1, 1}}}; }

std::optional<CameraImage> nothing() {
  std::this_thread::sleep_for(milliseconds(1));
  return std::nullopt;
}

constexpr CameraThreadConfig kQuick{
    .timeout = 0.05, .retry = 0.01, .is_recording = false, .capacity = 8};

/// The next event of a kind, or nothing after ten seconds.
template <class Event>
std::optional<Event> next(CameraThread& thread) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    auto event = thread.take(milliseconds(100));
    if (event && std::holds_alternative<Event>(*event)) return std::get<Event>(std::move(*event));
  }
  return std::nullopt;
}

TEST(CameraThread, SaysThatTheCameraIsOpenAndThenHandsOutItsImagesInOrder) {
  const auto began = std::chrono::system_clock::now();
  std::int64_t time = 0;
  CameraThread thread(open_fake([&] { return ++time % 2 ? depth(time) : color(time); }), kQuick);
  const auto first = thread.take(std::chrono::seconds(10));
  ASSERT_TRUE(first);
  ASSERT_TRUE(std::holds_alternative<CameraOpened>(*first));
  EXPECT_EQ(std::get<CameraOpened>(*first).description.name, "fake");
  std::int64_t before = 0;
  for (int i = 0; i < 20; ++i) {
    const auto arrived = next<ImageArrived>(thread);
    ASSERT_TRUE(arrived);
    EXPECT_GT(arrived->image.sensor_time, before);
    EXPECT_GE(arrived->arrival, began);
    before = arrived->image.sensor_time;
  }
}

TEST(CameraThread, ACameraThatCannotBeOpenedIsTriedAgain) {
  std::atomic<int> tries = 0;
  CameraThread thread(
      [&]() -> std::unique_ptr<RgbdCamera> {
        if (++tries < 3) throw SourceError("no camera");
        return std::make_unique<FakeCamera>(nothing, -1);
      },
      kQuick);
  EXPECT_EQ(next<CameraLost>(thread)->reason, "no camera");
  EXPECT_TRUE(next<CameraOpened>(thread));
  EXPECT_EQ(tries, 3);
}

TEST(CameraThread, ASilentCameraIsClosedAndOpenedAgain) {
  CameraThread thread(open_fake(nothing), kQuick);
  EXPECT_TRUE(next<CameraOpened>(thread));
  EXPECT_EQ(next<CameraLost>(thread)->reason, "fake: no whole depth image for 0.05 s");
  EXPECT_TRUE(next<CameraOpened>(thread));
}

TEST(CameraThread, ACameraWhoseColourAloneStopsIsClosedToo) {
  CameraThread thread(open_fake([] {
                        std::this_thread::sleep_for(milliseconds(1));
                        return depth(1);
                      }),
                      kQuick);
  EXPECT_EQ(next<CameraLost>(thread)->reason, "fake: no whole colour image for 0.05 s");
}

TEST(CameraThread, TheOldestImagesGiveWayWhenNobodyTakesThem) {
  std::atomic<std::int64_t> time = 0;
  CameraThread thread(open_fake([&] {
                        std::this_thread::sleep_for(milliseconds(1));
                        ++time;
                        return time % 2 ? depth(time) : color(time);
                      }),
                      kQuick);
  while (time < 100) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_GT(thread.dropped(), 80);
  EXPECT_GT(next<ImageArrived>(thread)->image.sensor_time, 80);
}

TEST(CameraThread, OfARecordingEveryImageIsKeptHoweverLateItIsTakenAndThenItEnds) {
  CameraThreadConfig config = kQuick;
  config.is_recording = true;
  std::int64_t time = 0;
  CameraThread thread(open_fake([&] { return ++time % 2 ? depth(time) : color(time); }, 50),
                      config);
  for (std::int64_t i = 1; i <= 50; ++i) {
    if (i == 20) std::this_thread::sleep_for(milliseconds(200));  // more than the time-out
    ASSERT_EQ(next<ImageArrived>(thread)->image.sensor_time, i);
  }
  EXPECT_TRUE(next<RecordingEnded>(thread));
  EXPECT_EQ(thread.dropped(), 0);
}

TEST(CameraThread, ARecordingThatCannotBePlayedIsNotTriedAgain) {
  CameraThreadConfig config = kQuick;
  config.is_recording = true;
  std::atomic<int> tries = 0;
  CameraThread thread(
      [&]() -> std::unique_ptr<RgbdCamera> {
        ++tries;
        throw SourceError("cut off");
      },
      config);
  EXPECT_EQ(next<CameraLost>(thread)->reason, "cut off");
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(tries, 1);
}

/// Needs a while to close, as one that finishes a recording does.
class SlowToClose : public FakeCamera {
 public:
  explicit SlowToClose(std::shared_ptr<std::atomic<bool>> is_closed)
      : FakeCamera(nothing, -1), is_closed_(std::move(is_closed)) {}
  ~SlowToClose() override {
    std::this_thread::sleep_for(milliseconds(300));
    *is_closed_ = true;
  }

 private:
  std::shared_ptr<std::atomic<bool>> is_closed_;
};

TEST(CameraThread, ACameraThatIsSlowToCloseIsWaitedForOrSaidToBeLeftBehind) {
  for (const double leave : {10.0, 0.01}) {
    CameraThreadConfig config = kQuick;
    config.timeout = 10.0;
    config.leave = leave;
    const auto is_closed = std::make_shared<std::atomic<bool>>(false);
    CameraThread thread([=] { return std::make_unique<SlowToClose>(is_closed); }, config);
    ASSERT_TRUE(next<CameraOpened>(thread));
    EXPECT_EQ(thread.close(), leave > 1.0);
    EXPECT_EQ(*is_closed, leave > 1.0);
    while (!*is_closed) std::this_thread::sleep_for(milliseconds(1));
  }
}

TEST(CameraThread, LossesOfAllCamerasAddUp) {
  CameraThread thread(open_fake(nothing), kQuick);
  next<CameraLost>(thread);
  const std::int64_t of_the_first = thread.losses().torn;
  EXPECT_GT(of_the_first, 0);
  next<CameraLost>(thread);
  EXPECT_GT(thread.losses().torn, of_the_first);
  EXPECT_EQ(thread.losses().missed, 2 * thread.losses().torn);
}

TEST(CameraThread, ACallThatDoesNotReturnIsSeenAndDoesNotKeepTheProgram) {
  const auto hangs = std::make_shared<std::atomic<bool>>(true);
  {
    CameraThread thread(open_fake([hangs] {
                          while (*hangs) std::this_thread::sleep_for(milliseconds(1));
                          return nothing();
                        }),
                        kQuick);
    while (thread.seconds_in_call() < 0.1) std::this_thread::sleep_for(milliseconds(1));
  }
  *hangs = false;
}

TEST(CameraThread, ASilentCameraThatCannotBeClosedIsSeen) {
  class Stuck : public FakeCamera {
   public:
    explicit Stuck(std::shared_ptr<std::atomic<bool>> hangs)
        : FakeCamera(nothing, -1), hangs_(std::move(hangs)) {}
    ~Stuck() override {
      while (*hangs_) std::this_thread::sleep_for(milliseconds(1));
    }

   private:
    std::shared_ptr<std::atomic<bool>> hangs_;
  };
  const auto hangs = std::make_shared<std::atomic<bool>>(true);
  CameraThread thread([hangs] { return std::make_unique<Stuck>(hangs); }, kQuick);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (thread.seconds_in_call() < 0.3 && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_GE(thread.seconds_in_call(), 0.3);
  *hangs = false;
  EXPECT_TRUE(next<CameraLost>(thread));
}

}  // namespace
}  // namespace geomap::drivers
