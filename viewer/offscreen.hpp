// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace geomap::viewer {

/// @brief An OpenGL 3.3 context without any window or display, current in the thread that made it
/// until it ends.
class OffscreenContext {
 public:
  /// @brief @throws std::runtime_error, one line that says which step failed, where there is none.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// @brief What draws, for people: "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string renderer() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace geomap::viewer
