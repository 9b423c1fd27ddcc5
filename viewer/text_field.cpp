// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/text_field.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>

namespace geomap::viewer {

bool text_field(const char* name, const char* hint, std::string& text) {
  std::array<char, 512> buffer{};
  std::copy_n(text.begin(), std::min(text.size(), buffer.size() - 1), buffer.begin());
  const bool is_entered = ImGui::InputTextWithHint(
      name, hint, buffer.data(), buffer.size(),
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  text = buffer.data();
  return is_entered;
}

}  // namespace geomap::viewer
