// What a design costs, in result.json: power and resources.
#include <result/result_members.h>

namespace platform::result {

using facts::Better;
using facts::PowerReport;
using facts::ResourceReport;

namespace {

constexpr int celsius_places = 6;
constexpr int block_places = 1;

/// A module, and whether there is energy of units.
struct PowerOfModule {
  const PowerReport::Module& module;
  bool per_unit;
};

std::vector<PowerOfModule> modules_of(const PowerReport& power) {
  std::vector<PowerOfModule> list;
  for (const PowerReport::Module& module : power.modules) list.push_back({module, power.per_frame});
  return list;
}

Members<PowerOfModule> power_of_module_members() {
  return Members<PowerOfModule>()
      .text("name", [](const PowerOfModule& of) { return of.module.name; })
      .text("rail", [](const PowerOfModule& of) { return of.module.rail; })
      .text("kind", [](const PowerOfModule& of) { return of.module.kind; })
      .figure(
          {"w", "W", "power of a module", Better::less},
          [](const PowerOfModule& of) { return of.module.w; }, energy_places)
      .figure(
          {"mj", "mJ", "energy of a module for one frame", Better::less},
          [](const PowerOfModule& of) {
            return of.per_unit ? std::optional(of.module.mj) : std::nullopt;
          },
          energy_places)
      .text("source", [](const PowerOfModule& of) { return of.module.source; });
}

Members<PowerReport::Activity> activity_members() {
  using Activity = PowerReport::Activity;
  return Members<Activity>()
      .text("name", &Activity::name)
      .figure({"toggle_rate", "1", "changes of a bit inside RTL in a clock"},
              &Activity::toggle_rate, energy_places)
      .figure({"signal_bits", "1", "bits of signals inside RTL"}, &Activity::bits);
}

Members<PowerReport> band_members() {
  return Members<PowerReport>()
      .figure({"low", "W", "lower end of its error band", Better::less}, &PowerReport::low_w,
              energy_places)
      .figure({"nominal", "W", "mean power of the chip", Better::less, "Power"},
              &PowerReport::total_w, energy_places)
      .figure({"high", "W", "upper end of its error band", Better::less}, &PowerReport::high_w,
              energy_places);
}

std::uint64_t whole(double amount) {
  return static_cast<std::uint64_t>(amount);
}

/// `of`: whose they are. Those that have titles are shown.
Members<ResourceReport::Amount> amount_members(const std::string& of, Better better,
                                               bool have_titles) {
  using Amount = ResourceReport::Amount;
  const auto kind = [&](const char* key, const char* text, const char* title) {
    return facts::Figure(key, "1", text + (" " + of), better, have_titles ? title : "");
  };
  return Members<Amount>()
      .figure(kind("lut", "LUT", "LUT"), [](const Amount& a) { return whole(a.lut); })
      .figure(kind("ff", "flip-flops", "Flip-flops"), [](const Amount& a) { return whole(a.ff); })
      .figure(kind("bram36", "blocks of memory, 36 Kb each,", "BRAM 36 Kb"), &Amount::bram36,
              block_places)
      .figure(kind("dsp", "DSP", "DSP"), [](const Amount& a) { return whole(a.dsp); });
}

Members<ResourceReport::Module> resources_of_module_members() {
  using Module = ResourceReport::Module;
  return Members<Module>()
      .text("name", &Module::name)
      .with(amount_members("that a module takes", Better::less, false),
            [](const Module& module) { return module.known ? &module.amount : nullptr; })
      .figure({"uncertainty_percent", "%", "how far its figures may be off", Better::less},
              [](const Module& module) {
                return module.known ? std::optional(module.uncertainty_percent) : std::nullopt;
              })
      .text("source", &Module::source);
}

}  // namespace

const Members<PowerReport>& power_summary_members() {
  static const Members<PowerReport> members =
      Members<PowerReport>()
          .figure({"total", "W", "mean power of the chip", Better::less}, &PowerReport::total_w,
                  energy_places)
          .figure({"ps", "W", "of it the processing system", Better::less}, &PowerReport::ps_w,
                  energy_places)
          .figure({"pl", "W", "of it the programmable logic", Better::less}, &PowerReport::pl_w,
                  energy_places)
          .figure({"static", "W", "of it the device at rest", Better::less}, &PowerReport::static_w,
                  energy_places);
  return members;
}

const Members<PowerReport>& power_members() {
  static const Members<PowerReport> members =
      Members<PowerReport>()
          .text("mode", &PowerReport::mode)
          .text("table", &PowerReport::table)
          .figure({"ambient_c", "°C", "temperature around the board"}, &PowerReport::ambient_c,
                  celsius_places)
          .figure({"junction_c", "°C", "temperature of the die", Better::less, "Junction"},
                  &PowerReport::junction_c, celsius_places)
          .group("total_w", band_members())
          .named(
              "rails", {{"*", "W", "power of a supply rail", Better::less}},
              [](const PowerReport& power, const auto& found) {
                for (const auto& [rail, value] : power.rails) found(rail, value);
              },
              energy_places)
          .list("modules", power_of_module_members(), modules_of)
          .list("activity", activity_members(), &PowerReport::activity, false);
  return members;
}

const Members<ResourceReport>& resource_members() {
  const auto is_known = [](const ResourceReport& resources) { return resources.unknown.empty(); };
  static const Members<ResourceReport> members =
      Members<ResourceReport>()
          .text("device", &ResourceReport::device)
          .list("modules", resources_of_module_members(), &ResourceReport::modules)
          .object("total", amount_members("that the design takes", Better::less, true),
                  [=](const ResourceReport& resources) {
                    return is_known(resources) ? &resources.total : nullptr;
                  })
          .object("available", amount_members("that the device has", Better::more, false),
                  [](const ResourceReport& resources) { return &resources.available; })
          .figure({"fits", "1", "1 if the device has room for the design", Better::more},
                  [=](const ResourceReport& resources) {
                    const bool is_judged = is_known(resources) || !resources.over.empty();
                    return is_judged ? std::optional(resources.over.empty()) : std::nullopt;
                  })
          .text("over", &ResourceReport::over)
          .text("unknown", [=](const ResourceReport& resources) {
            return is_known(resources) ? std::nullopt : std::optional(resources.unknown);
          });
  return members;
}

}  // namespace platform::result
