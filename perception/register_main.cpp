// SPDX-License-Identifier: BSD-3-Clause
// geomap-register: key frames, their poses, and the point map.
#include "perception/register_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-register",
       .description = "Chooses key frames, finds their poses, and keeps the point map: RGBD_FRAME "
                      "and POSE in, KEYFRAME and CAMERA_POSE out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) { messaging::declare_live(parser, options); },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-register", common, options);
        perception::RegisterProcess process(perception::read_register_config(common.config), live);
        return live.run([&] { process.finish(); }, [&] { return process.summary(); });
      });
}
