// SPDX-License-Identifier: BSD-3-Clause
// geomap-register: key frames, their poses, and the point map.
#include "perception/register_process.hpp"

int main(int argc, char** argv) {
  using namespace geomap;
  messaging::LiveOptions options;
  std::string state_folder;
  return messaging::run_program(
      argc, argv,
      {.name = "geomap-register",
       .description = "Chooses key frames, finds their poses, and keeps the point map: RGBD_FRAME "
                      "and POSE in, KEYFRAME and CAMERA_POSE out.",
       .uses_lcm = true},
      [&](messaging::OptionParser& parser) {
        messaging::declare_live(parser, options);
        parser.option("--state", state_folder,
                      "folder for key frames, to go on from after a restart; empty: none");
      },
      [&](const messaging::CommonOptions& common) {
        messaging::LiveProcess live("geomap-register", common, options);
        perception::RegisterConfig config = perception::read_register_config(common.config);
        config.state_folder = state_folder;
        perception::RegisterProcess process(config, live);
        return live.run([&] { process.finish(); }, [&] { return process.summary(); });
      });
}
