#include <chip/run/software_options.h>

#include <chip/system/option_files.h>
#include <hal/option_data.h>
#include <ps/cpu/program.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/unit.h>
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace platform {

using profiles::Optimisation;

namespace {

constexpr std::uintmax_t most_option_bytes = 64 << 20;

/// The dimension a unit's name belongs to.
vp::Unit dimension_of(const std::string& unit, const hal_program& program, const char* option) {
  if (unit.empty()) return vp::Unit::none;
  using vp::Unit;
  for (Unit dimension :
       {Unit::frequency, Unit::time, Unit::bytes, Unit::pixels, Unit::length, Unit::power,
        Unit::energy, Unit::voltage, Unit::cycles, Unit::percent, Unit::angle, Unit::temperature}) {
    for (const std::string& known : vp::allowed_units(dimension)) {
      if (known == unit) return dimension;
    }
  }
  throw vp::InputError("program '" + std::string(program.name) + "': its option '" + option +
                       "' has the unknown unit '" + unit + "'");
}

/// `range` must hold it: the clock is the user's, the range the program's.
void check_clock(std::uint64_t hz, const vp::Range<double>& range, const hal_program& program) {
  const auto text = [](double value) {
    return vp::format_quantity(vp::Decimal(value), vp::Unit::frequency);
  };
  const auto clock = static_cast<double>(hz);
  if (range.min <= clock && clock <= range.max) return;
  throw vp::InputError("ps.cpu_clk.frequency is " + text(clock) + ": program '" + program.name +
                       "' can be built for " + text(range.min) + " to " + text(range.max));
}

}  // namespace

SoftwareOptions::SoftwareOptions(sc_core::sc_module_name name, const hal_program& program,
                                 const std::string& profile, std::uint64_t cpu_hz,
                                 const CameraTiming& camera, Design& design)
    : sc_module(name),
      opt_("opt", profiles::optimisation_of(profile),
           {{"O0", Optimisation::o0}, {"O2", Optimisation::o2}}, vp::Source::derived,
           "how the software is compiled; the thesis' times are those of -O0, the vendor tool's "
           "default") {
  opt_.follows("profile");
  is_unoptimised_ = opt_.get() == Optimisation::o0 && profiles::holds_for_both(profile);
  for (std::uint32_t i = 0; i < program.option_count; ++i) {
    const hal_option_info& info = program.options[i];
    if (const auto decided = design.program_option(info.name)) {
      values_.push_back(*decided);
      continue;
    }
    if (info.unit == std::string_view(HAL_UNIT_FILE)) {
      values_.push_back(read_file(i, info, design));
      continue;
    }
    if (const auto names = ps::option_names(info); !names.empty()) {
      const auto& chosen =
          names_.emplace_back(info.name, names.at(static_cast<std::size_t>(info.default_value)),
                              names, vp::Source::decision, info.documentation);
      const auto place = std::find(names.begin(), names.end(), chosen.get()) - names.begin();
      values_.push_back(static_cast<double>(place));
      continue;
    }
    const vp::Unit dimension = dimension_of(info.unit, program, info.name);
    // Parameters are kept in the base unit of their dimension; the program thinks in its own.
    const double base =
        dimension == vp::Unit::none
            ? 1
            : vp::parse_quantity(std::string("1 ") + info.unit, dimension).to_double();
    const vp::Range<double> range{info.minimum * base, info.maximum * base};
    const bool is_clock = info.name == std::string_view("cpu_clock");
    const bool is_upload = info.name == std::string_view("upload");
    double usual = info.default_value * base;
    if (is_clock) {
      check_clock(cpu_hz, range, program);
      usual = static_cast<double>(cpu_hz);
    }
    // At a rate it would sleep until the next input before it works on the last.
    const bool is_overlap = info.name == std::string_view("overlap");
    if ((is_upload || is_overlap) && camera.has_rate()) usual = 0;
    const auto& parameter = parameters_.emplace_back(info.name, usual, dimension, range,
                                                     vp::Source::decision, info.documentation);
    if (is_clock) parameter.follows("ps.cpu_clk.frequency");
    if (is_upload || is_overlap) parameter.follows(camera.rate.name());
    if (is_upload && camera.has_rate() && parameter >= 0.5) {
      throw vp::InputError(std::string(parameter.name()) + " is " + parameter.text() + ", and " +
                           camera.rate.name() + " is " + camera.rate.text() +
                           ": inputs at a rate upload themselves; leave one of them out");
    }
    values_.push_back(parameter.get() / base);
    if (is_upload) uploads_ = parameter >= 0.5;
  }
}

double SoftwareOptions::read_file(std::uint32_t option, const hal_option_info& info,
                                  Design& design) {
  const std::string& path =
      files_.emplace_back(info.name, "", vp::Source::decision, info.documentation).get();
  if (path.empty()) return 0;
  // So that sweeps know it for a file, whose contents count.
  if (std::filesystem::path(path).extension().empty()) {
    throw vp::InputError(std::string("sw.") + info.name + ": '" + path +
                         "' has no extension: give its name one, like .yml");
  }
  auto* knows = dynamic_cast<OptionFiles*>(&design);
  data_[option] = knows ? knows->option_data(info.name, path)
                        : vp::read_text(path, std::string("sw.") + info.name, most_option_bytes);
  return 1;
}

const std::string& SoftwareOptions::data(std::uint32_t option) const {
  static const std::string nothing;
  const auto found = data_.find(option);
  return found == data_.end() ? nothing : found->second;
}

std::optional<Optimisation> SoftwareOptions::optimisation() const {
  if (!opt_.is_changed()) return std::nullopt;
  return opt_.get();
}

}  // namespace platform
