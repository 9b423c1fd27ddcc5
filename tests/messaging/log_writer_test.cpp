// SPDX-License-Identifier: BSD-3-Clause
#include "messaging/log_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "bot_core/pose_t.hpp"
#include "messaging/log_reader.hpp"
#include "messaging/safe_decode.hpp"
#include "messaging/temporary_folder.hpp"

namespace geomap::messaging {
namespace {

using LogWriterTest = testing::TemporaryFolder;

bot_core::pose_t pose_at(std::int64_t utime) {
  bot_core::pose_t pose{};
  pose.utime = utime;
  pose.orientation[0] = 1.0;
  return pose;
}

TEST_F(LogWriterTest, WritesMessagesThatCanBeDecodedAgain) {
  LogWriter writer(path("poses.lcmlog"));
  for (const std::int64_t utime : {30, 10, 20}) writer.write("POSE", utime, pose_at(utime));
  writer.close();

  LogReader reader(path("poses.lcmlog"));
  for (const std::int64_t utime : {30, 10, 20}) {
    const auto event = reader.next();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->channel, "POSE");
    EXPECT_EQ(event->log_utime, utime);
    const auto pose = safe_decode<bot_core::pose_t>(event->data.data(), event->data.size());
    ASSERT_TRUE(pose.message);
    EXPECT_EQ(pose.message->utime, utime);
  }
  EXPECT_FALSE(reader.next());
}

TEST_F(LogWriterTest, WritesTheSameBytesForTheSameMessages) {
  for (const char* name : {"a.lcmlog", "b.lcmlog"}) {
    LogWriter writer(path(name));
    writer.write("POSE", 5, pose_at(5));
    writer.close();
  }
  EXPECT_EQ(read_file(path("a.lcmlog")), read_file(path("b.lcmlog")));
}

/// The format is public: big-endian, see the LCM manual.
TEST_F(LogWriterTest, WritesLcmsFormatByteForByte) {
  LogWriter writer(path("bytes.lcmlog"));
  const std::vector<std::uint8_t> data = {0xaa, 0xbb};
  writer.write_bytes("CH", 0x0102030405060708, data);
  writer.close();
  const std::string expected(
      "\xed\xa1\xda\x01"
      "\0\0\0\0\0\0\0\0"
      "\x01\x02\x03\x04\x05\x06\x07\x08"
      "\0\0\0\x02"
      "\0\0\0\x02"
      "CH\xaa\xbb",
      32);
  EXPECT_EQ(read_file(path("bytes.lcmlog")), expected);
}

TEST_F(LogWriterTest, CopiesEventsOfAnotherLogWithTheirNumbers) {
  LogWriter original(path("original.lcmlog"));
  for (const std::int64_t utime : {30, -1, 20}) original.write("POSE", utime, pose_at(utime));
  original.close();
  LogReader reader(path("original.lcmlog"));
  LogWriter copy(path("copy.lcmlog"));
  reader.next();
  while (const auto event = reader.next()) copy.copy(*event);
  copy.close();
  const std::string bytes = read_file(path("original.lcmlog"));
  EXPECT_EQ(read_file(path("copy.lcmlog")), bytes.substr(bytes.size() / 3));
}

TEST_F(LogWriterTest, AnEmptyMessageIsAnEvent) {
  LogWriter writer(path("empty.lcmlog"));
  writer.write_bytes("NOTHING", 1, {});
  writer.close();
  EXPECT_TRUE(LogReader(path("empty.lcmlog")).next()->data.empty());
}

TEST_F(LogWriterTest, AppendsToAJournal) {
  for (const std::int64_t utime : {1, 2}) {
    LogWriter writer(path("journal.lcmlog"), LogWriter::Mode::kAppend);
    writer.write("POSE", utime, pose_at(utime));
    writer.close();
  }
  LogReader reader(path("journal.lcmlog"));
  EXPECT_EQ(reader.next()->log_utime, 1);
  EXPECT_EQ(reader.next()->log_utime, 2);
}

TEST_F(LogWriterTest, FlushedEventsAreInTheFile) {
  LogWriter writer(path("flushed.lcmlog"));
  writer.write("POSE", 1, pose_at(1));
  writer.flush();
  EXPECT_TRUE(LogReader(path("flushed.lcmlog")).next());
}

TEST_F(LogWriterTest, AFolderThatIsNotThereIsSaidInOneLine) {
  try {
    LogWriter writer(path("nowhere/log.lcmlog"));
    FAIL() << "a log in a missing folder was opened";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("nowhere/log.lcmlog"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("No such file"));
  }
}

TEST_F(LogWriterTest, AFullDiskIsNoticed) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  LogWriter writer("/dev/full");
  const std::vector<std::uint8_t> data(1'000'000);
  EXPECT_THROW(
      {
        writer.write_bytes("CH", 1, data);
        writer.close();
      },
      std::runtime_error);
}

TEST_F(LogWriterTest, WritingAfterCloseIsACallersMistake) {
  LogWriter writer(path("closed.lcmlog"));
  writer.close();
  EXPECT_THROW(writer.write_bytes("CH", 1, {}), std::logic_error);
}

}  // namespace
}  // namespace geomap::messaging
