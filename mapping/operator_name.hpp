// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace geomap::mapping {

/// @brief Who edits from this program: "user@host", as EditCommand::author takes it.
std::string operator_name();

/// @brief Numbers for an author's commands: microseconds of the host's clock, and each one larger
/// than the one before, so that no two commands are taken for the same.
class CommandNumbers {
 public:
  std::int64_t next();

 private:
  std::int64_t last_ = 0;
};

}  // namespace geomap::mapping
