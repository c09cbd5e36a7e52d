#include <pl/feature_extraction/fidelity_choice.h>

#include <string>

#include <vp/error.h>

namespace pl {

namespace {

const vp::Choices<Fidelity>& names() {
  static const vp::Choices<Fidelity> names{{"clocked", Fidelity::clocked}, {"tlm", Fidelity::tlm}};
  return names;
}

constexpr const char* documentation = "how this IP is modelled: clock by clock, or whole frames";

Fidelity clocked_if(bool condition, Fidelity otherwise) {
  return condition ? Fidelity::clocked : otherwise;
}

[[noreturn]] void refuse(const FidelityChoice::Choice& choice, const FidelityChoice::Choice& other,
                         const std::string& why) {
  throw vp::InputError(std::string(choice.name()) + " = " + choice.text() + " does not go with " +
                       other.name() + " = " + other.text() + ": " + why);
}

}  // namespace

FidelityChoice::FidelityChoice(sc_core::sc_module_name name, Fidelity otherwise)
    : sc_module(name),
      axi_image_store("axi_image_store", otherwise, names(), vp::Source::decision, documentation),
      axi_threshold_bridge("axi_threshold_bridge", otherwise, names(), vp::Source::decision,
                           documentation),
      blob_detection("blob_detection", otherwise, names(), vp::Source::decision, documentation),
      global_threshold("global_threshold", blob_detection, names(), vp::Source::decision,
                       documentation),
      corner_detection("corner_detection", otherwise, names(), vp::Source::decision, documentation),
      sensor_input(
          "sensor_input",
          clocked_if(corner_detection == Fidelity::clocked || global_threshold == Fidelity::clocked,
                     otherwise),
          names(), vp::Source::decision, documentation) {
  for (const Choice* consumer : {&corner_detection, &global_threshold}) {
    if (*consumer == Fidelity::clocked && sensor_input == Fidelity::tlm) {
      refuse(sensor_input, *consumer, "a clocked detector needs the pixels one by one");
    }
  }
  if (blob_detection != global_threshold) {
    refuse(blob_detection, global_threshold,
           "the binary image goes from one to the other pixel by pixel, or as a whole: choose one");
  }
}

}  // namespace pl
