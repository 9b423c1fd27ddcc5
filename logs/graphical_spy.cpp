// SPDX-License-Identifier: BSD-3-Clause
#include "logs/graphical_spy.hpp"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "messaging/bus.hpp"

namespace geomap::logs {

namespace fs = std::filesystem;

void run_graphical_spy(const messaging::CommonOptions& common) {
  const fs::path jar = fs::read_symlink("/proc/self/exe").replace_filename("geomap-spy.jar");
  if (!fs::exists(jar)) {
    throw std::runtime_error(
        "the graphical spy was not built; install default-jdk, liblcm-java and libjchart2d-java "
        "and build again, or use --text");
  }
  // Says what is wrong with the URL, which Java would not.
  messaging::Bus({common.lcm_url, common.channel_prefix});
  // Java's multicast works over IPv4 only where that is preferred.
  execlp("java", "java", "-Djava.net.preferIPv4Stack=true", "-Xmx256m", "-jar", jar.c_str(),
         "--lcm-url", common.lcm_url.c_str(), nullptr);
  throw std::runtime_error("there is no java; install default-jre, or use --text");
}

}  // namespace geomap::logs
