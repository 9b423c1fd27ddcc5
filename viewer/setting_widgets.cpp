// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/setting_widgets.hpp"

#include <imgui.h>

namespace geomap::viewer {

bool slider(const char* name, double& value, double low, double high, const char* format) {
  return ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &low, &high, format,
                             ImGuiSliderFlags_AlwaysClamp);
}

bool choice(const char* name, int& chosen, std::span<const char* const> words) {
  return ImGui::Combo(name, &chosen, words.data(), static_cast<int>(words.size()));
}

}  // namespace geomap::viewer
