// SPDX-License-Identifier: BSD-3-Clause
#include "logs/doctor.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace geomap::logs {
namespace {

using Level = Finding::Level;

TEST(Doctor, ReadsMulticastUrls) {
  const MulticastUrl url = parse_multicast_url("udpm://239.1.2.3:7000?ttl=1&recv_buf_size=2097152");
  EXPECT_EQ(url.group, "239.1.2.3");
  EXPECT_EQ(url.port, 7000);
  EXPECT_EQ(url.ttl, 1);
  EXPECT_EQ(url.receive_buffer, 2097152);
  EXPECT_EQ(parse_multicast_url("udpm://").port, 7667);
  EXPECT_EQ(parse_multicast_url("udpm://:7668").group, "239.255.76.67");
  EXPECT_THROW(parse_multicast_url("udpm://?ttl=much"), std::invalid_argument);
  EXPECT_THROW(parse_multicast_url("tcpq://"), std::invalid_argument);
}

class DoctorBuffers : public ::testing::Test {
 protected:
  // Settings of a system as /proc/sys/net shows them.
  std::filesystem::path system(long rmem_max, long rmem_default, long ipfrag = 134'217'728) {
    const auto root = std::filesystem::path(::testing::TempDir()) / "geomap_doctor";
    std::filesystem::create_directories(root / "core");
    std::filesystem::create_directories(root / "ipv4");
    std::ofstream(root / "core" / "rmem_max") << rmem_max << "\n";
    std::ofstream(root / "core" / "rmem_default") << rmem_default << "\n";
    std::ofstream(root / "ipv4" / "ipfrag_high_thresh") << ipfrag << "\n";
    return root;
  }
};

TEST_F(DoctorBuffers, AnUrlWithoutABufferLosesFrames) {
  const auto findings =
      check_buffers(parse_multicast_url("udpm://?ttl=0"), system(4194304, 212992));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].level, Level::kFault);
  EXPECT_NE(findings[0].remedy.find("LCM_DEFAULT_URL"), std::string::npos);
}

TEST_F(DoctorBuffers, ASystemThatGrantsTooLittleIsToldHowToGrantMore) {
  const auto findings =
      check_buffers(parse_multicast_url("udpm://?recv_buf_size=2097152"), system(212992, 212992));
  EXPECT_EQ(findings[0].level, Level::kFault);
  EXPECT_EQ(findings[0].remedy, "sudo sysctl -w net.core.rmem_max=2097152");
}

TEST_F(DoctorBuffers, EnoughIsGood) {
  const auto settings = system(4194304, 212992);
  EXPECT_EQ(check_buffers(parse_multicast_url("udpm://?recv_buf_size=2097152"), settings)[0].level,
            Level::kGood);
}

TEST_F(DoctorBuffers, OnALinkReassemblyMattersToo) {
  const auto findings = check_buffers(parse_multicast_url("udpm://?ttl=1&recv_buf_size=2097152"),
                                      system(4194304, 212992, 4194304));
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[1].level, Level::kNote);
}

TEST(Doctor, EveryFaultIsPrintedWithItsRemedy) {
  const std::string text =
      to_string({{Level::kFault, "broken", "mend it"}, {Level::kGood, "fine", {}}});
  EXPECT_EQ(text, "FAULT  broken\n         mend it\ngood   fine\n");
}

}  // namespace
}  // namespace geomap::logs
