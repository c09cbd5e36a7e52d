#include <device/device.h>

#include <algorithm>
#include <cctype>

#include <host/machine.h>
#include <vp/error.h>
#include <vp/text.h>

namespace platform::device {

namespace {

namespace fs = std::filesystem;

std::vector<Device> installed_devices() {
  std::vector<Device> all;
  std::string searched;
  for (const std::string& library : host::library_folders()) {
    const fs::path folder = fs::path(library) / "devices";
    if (searched.empty()) searched = folder.string();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() != ".json") continue;
      for (Device& device : read_devices(entry.path())) all.push_back(std::move(device));
    }
    if (!all.empty()) break;  // the first folder that has any, as for other data
  }
  if (all.empty()) {
    throw vp::InputError("no devices are installed in " + searched +
                         "; install markervp completely");
  }
  std::sort(all.begin(), all.end(),
            [](const Device& a, const Device& b) { return a.name() < b.name(); });
  return all;
}

}  // namespace

const char* to_string(Confidence confidence) {
  switch (confidence) {
    case Confidence::published:
      return "published";
    case Confidence::derived:
      return "derived";
    case Confidence::assumed:
      return "assumed";
  }
  return "";
}

// UG585 appendix B.28: manufacturer, family, and the code of the device between them.
std::uint32_t Device::idcode() const {
  return 0x0372'0093 | static_cast<std::uint32_t>(device_code.value) << 12;
}

const std::vector<FigureInfo>& figures() {
  using Owner = FigureInfo::Owner;
  static const std::vector<FigureInfo> all = {
      {"lut", "", "look-up tables", Owner::part, &Device::lut, 1, 1e7, true},
      {"ff", "", "flip-flops", Owner::part, &Device::ff, 1, 1e7, true},
      {"bram36", "", "block memories of 36 kbit", Owner::part, &Device::bram36, 1, 1e5, true},
      {"dsp", "", "DSP48 slices", Owner::part, &Device::dsp, 1, 1e5, true},
      {"cores", "", "Cortex-A9 cores", Owner::part, &Device::cores, 1, 2, true},
      {"static_w", "W", "static power at a junction of 25 C", Owner::part, &Device::static_w, 0.001,
       100},
      {"device_code", "", "bits 12 to 16 of IDCODE", Owner::part, &Device::device_code, 0, 31,
       true},
      {"cpu_621_mhz", "MHz", "highest CPU clock, ratio 6:2:1", Owner::grade, &Device::cpu_621_mhz,
       1, 10'000},
      {"cpu_421_mhz", "MHz", "highest CPU clock, ratio 4:2:1", Owner::grade, &Device::cpu_421_mhz,
       1, 10'000},
      {"ddr_mhz", "MHz", "highest memory clock, DDR3 or DDR3L", Owner::grade, &Device::ddr_mhz, 1,
       10'000},
      {"fclk_mhz", "MHz", "highest clock to the PL", Owner::grade, &Device::fclk_mhz, 1, 10'000},
      {"vco_max_mhz", "MHz", "highest output of a PLL", Owner::grade, &Device::vco_max_mhz, 1,
       10'000},
      {"fmax_factor", "", "Fmax of logic over that of grade -1", Owner::grade, &Device::fmax_factor,
       0.1, 10},
      {"crystal_min_mhz", "MHz", "lowest PS_CLK", Owner::family, &Device::crystal_min_mhz, 1,
       1'000},
      {"crystal_max_mhz", "MHz", "highest PS_CLK", Owner::family, &Device::crystal_max_mhz, 1,
       1'000},
      {"pll_feedback_min", "", "least feedback divider of a PLL", Owner::family,
       &Device::pll_feedback_min, 1, 127, true},
      {"pll_feedback_max", "", "largest feedback divider of a PLL", Owner::family,
       &Device::pll_feedback_max, 1, 127, true},
      {"vco_min_mhz", "MHz", "lowest output of a PLL", Owner::family, &Device::vco_min_mhz, 1,
       10'000},
      {"divisor_max", "", "largest divisor behind a PLL", Owner::family, &Device::divisor_max, 1,
       63, true},
  };
  return all;
}

const std::vector<Device>& devices() {
  static const std::vector<Device> all = installed_devices();
  return all;
}

const Device& find_device(const std::string& name) {
  std::string wanted = name;
  std::transform(wanted.begin(), wanted.end(), wanted.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::vector<std::string> names;
  for (const Device& device : devices()) {  // the slowest grade of a part comes first
    if (wanted == device.name() || wanted == device.part) return device;
    names.push_back(device.name());
  }
  const std::string nearest = vp::nearest_match(wanted, names);
  throw vp::InputError("unknown device '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       "there are " + vp::join(names, ", "));
}

}  // namespace platform::device
