#include <vp/parameter.h>

#include <boost/test/unit_test.hpp>

#include "input_error.h"
#include "simulation.h"

using vp::Configuration;
using vp::Parameter;
using vp::Source;
using vp::Unit;

namespace {

enum class Fidelity { clocked, tlm };

struct Detector : sc_core::sc_module {
  explicit Detector(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}

  Parameter<std::uint32_t> threshold{
      "threshold", 30, Unit::none, {0, 255}, Source::decision, "contrast of a corner"};
  Parameter<std::uint64_t> frequency{"frequency",       50'000'000,
                                     Unit::frequency,   {1'000'000, 200'000'000},
                                     Source::published, "pixel clock"};
  Parameter<double> side{
      "side", 0.06, Unit::length, {0.001, 1.0}, Source::published, "side of the marker"};
  Parameter<double> gain{"gain", 1.0, Unit::none, Source::assumed, "sensor gain"};
  Parameter<std::int8_t> offset{"offset", -3, Unit::none, Source::derived, "black level"};
  Parameter<bool> enabled{"enabled", true, Source::decision, "runs at all"};
  Parameter<std::string> label{"label", "none given", Source::decision, "free text"};
  Parameter<std::string> variant{
      "variant", "thesis", {"thesis", "merging"}, Source::published, "which algorithm"};
  Parameter<Fidelity> fidelity{"fidelity",
                               Fidelity::tlm,
                               {{"clocked", Fidelity::clocked}, {"tlm", Fidelity::tlm}},
                               Source::decision,
                               "level of detail"};
};

struct Board : sc_core::sc_module {
  explicit Board(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  Detector detector{"detector"};
};

struct Fixture : kit::Simulation {
  Configuration configuration;

  /// The error of building the board with one setting.
  std::string refusal(const char* path, const char* value) {
    configuration.set(path, value);
    return input_error([this] {
      const Configuration::Scope scope(configuration);
      Board board("pl");
    });
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(parameter, Fixture)

BOOST_AUTO_TEST_CASE(a_list_is_for_parameters_that_take_one) {
  configuration.load_text("pl:\n  detector:\n    label: [{a: 1}]\nfaults: [{b: 2}]", "f.yaml");
  const Configuration::Scope scope(configuration);
  const vp::ListParameter faults("faults", Source::decision, "what goes wrong");
  BOOST_TEST(faults.get() == "[{b: 2}]");
  BOOST_TEST(faults.origin() == "f.yaml:4");
  BOOST_TEST(input_error([] { Board board("pl"); }) ==
             "pl.detector.label: '[{a: 1}]' (f.yaml:3) is a list: write one value");
}

BOOST_AUTO_TEST_CASE(without_a_configuration_defaults_hold) {
  Board board("pl");
  BOOST_TEST(board.detector.threshold == 30u);
  BOOST_TEST(board.detector.frequency == 50'000'000u);
  BOOST_TEST(board.detector.side == 0.06);
  BOOST_TEST(board.detector.offset.get() == -3);
  BOOST_TEST(board.detector.enabled.get());
  BOOST_TEST(board.detector.label.get() == "none given");
  BOOST_TEST(board.detector.variant.get() == "thesis");
  BOOST_TEST((board.detector.fidelity == Fidelity::tlm));
  BOOST_TEST(!board.detector.threshold.is_changed());
}

BOOST_AUTO_TEST_CASE(the_key_is_the_hierarchical_name) {
  Board board("pl");
  BOOST_TEST(board.detector.threshold.name() == "pl.detector.threshold");
  BOOST_TEST(board.detector.threshold.kind() == "vp::Parameter");
}

BOOST_AUTO_TEST_CASE(a_default_that_is_written_down_is_no_change) {
  configuration.set("pl.detector.threshold=30");
  configuration.set("pl.detector.frequency=50000 kHz");
  configuration.set("pl.detector.side=60 mm");
  configuration.set("pl.detector.enabled=yes");
  const Configuration::Scope scope(configuration);
  Board board("pl");
  BOOST_TEST(!board.detector.threshold.is_changed());
  BOOST_TEST(!board.detector.frequency.is_changed());
  BOOST_TEST(!board.detector.side.is_changed());
  BOOST_TEST(!board.detector.enabled.is_changed());
}

BOOST_AUTO_TEST_CASE(settings_win_over_defaults) {
  configuration.set("pl.detector.threshold=45");
  configuration.set("pl.detector.frequency=148.5 MHz");
  configuration.set("pl.detector.side", "200 mm");
  configuration.set("pl.detector.offset", "-128");
  configuration.set("pl.detector.enabled", "off");
  configuration.set("pl.detector.label", "a = b");
  configuration.set("pl.detector.variant", "merging");
  configuration.set("pl.detector.fidelity", "clocked");
  const Configuration::Scope scope(configuration);
  Board board("pl");
  BOOST_TEST(board.detector.threshold == 45u);
  BOOST_TEST(board.detector.threshold.is_changed());
  BOOST_TEST(board.detector.frequency == 148'500'000u);
  BOOST_TEST(board.detector.frequency.text() == "148.5 MHz");
  BOOST_TEST(board.detector.side == 0.2);
  BOOST_TEST(board.detector.offset.get() == -128);
  BOOST_TEST(!board.detector.enabled.get());
  BOOST_TEST(board.detector.label.get() == "a = b");
  BOOST_TEST(board.detector.variant.get() == "merging");
  BOOST_TEST((board.detector.fidelity == Fidelity::clocked));
  BOOST_CHECK_NO_THROW(configuration.check_unused());
}

BOOST_AUTO_TEST_CASE(limits_are_allowed_values) {
  configuration.set("pl.detector.threshold", "255");
  configuration.set("pl.detector.frequency", "1 MHz");
  const Configuration::Scope scope(configuration);
  Board board("pl");
  BOOST_TEST(board.detector.threshold == 255u);
  BOOST_TEST(board.detector.frequency == 1'000'000u);
}

BOOST_AUTO_TEST_CASE(out_of_range_names_the_range) {
  BOOST_TEST(refusal("pl.detector.threshold", "256") ==
             "pl.detector.threshold: '256' (--set) is out of range: allowed is 0 to 255");
}

BOOST_AUTO_TEST_CASE(out_of_range_names_the_range_with_units) {
  BOOST_TEST(refusal("pl.detector.frequency", "1 GHz") ==
             "pl.detector.frequency: '1 GHz' (--set) is out of range: allowed is 1 MHz to 200 MHz");
}

BOOST_AUTO_TEST_CASE(out_of_range_of_a_real_number) {
  BOOST_TEST(refusal("pl.detector.side", "2 m") ==
             "pl.detector.side: '2 m' (--set) is out of range: allowed is 1 mm to 1 m");
}

BOOST_AUTO_TEST_CASE(too_large_for_the_type_is_out_of_range) {
  BOOST_TEST(refusal("pl.detector.offset", "1e300") ==
             "pl.detector.offset: '1e300' (--set) is out of range: allowed is -128 to 127");
  BOOST_TEST(refusal("pl.detector.offset", "-129") ==
             "pl.detector.offset: '-129' (--set) is out of range: allowed is -128 to 127");
}

BOOST_AUTO_TEST_CASE(infinity_is_refused) {
  BOOST_TEST(refusal("pl.detector.gain", "1e400").find("is out of range") != std::string::npos);
  BOOST_TEST(refusal("pl.detector.gain", "nan") ==
             "pl.detector.gain: 'nan' (--set) is not a number");
}

BOOST_AUTO_TEST_CASE(a_fraction_is_not_a_whole_number) {
  BOOST_TEST(refusal("pl.detector.threshold", "30.5") ==
             "pl.detector.threshold: '30.5' (--set) is not a whole number");
}

BOOST_AUTO_TEST_CASE(a_fraction_of_the_base_unit_is_not_a_whole_number) {
  BOOST_TEST(refusal("pl.detector.frequency", "50.0000001 MHz") ==
             "pl.detector.frequency: '50.0000001 MHz' (--set) is not a whole number of Hz");
}

BOOST_AUTO_TEST_CASE(a_missing_unit_is_refused) {
  BOOST_TEST(refusal("pl.detector.frequency", "50") ==
             "pl.detector.frequency: '50' (--set) has no unit: write it in Hz, kHz, MHz or GHz");
}

BOOST_AUTO_TEST_CASE(a_wrong_unit_is_refused) {
  BOOST_TEST(refusal("pl.detector.side", "3 px") ==
             "pl.detector.side: '3 px' (--set) has the wrong unit 'px': write it in um, mm or m");
}

BOOST_AUTO_TEST_CASE(a_value_that_is_no_truth_is_refused) {
  BOOST_TEST(refusal("pl.detector.enabled", "maybe") ==
             "pl.detector.enabled: 'maybe' (--set) is neither true nor false");
}

BOOST_AUTO_TEST_CASE(an_unknown_choice_names_the_nearest) {
  BOOST_TEST(refusal("pl.detector.fidelity", "clokced") ==
             "pl.detector.fidelity: 'clokced' (--set) is not one of its values, clocked or tlm: "
             "did you mean 'clocked'?");
}

BOOST_AUTO_TEST_CASE(an_unknown_choice_without_a_near_one) {
  BOOST_TEST(refusal("pl.detector.variant", "otsu-rtl") ==
             "pl.detector.variant: 'otsu-rtl' (--set) is not one of its values, thesis or merging");
}

BOOST_AUTO_TEST_CASE(the_origin_is_the_line_of_the_file) {
  configuration.load_text("pl:\n  detector:\n    threshold: 300\n", "board.yaml");
  const std::string message = input_error([this] {
    const Configuration::Scope scope(configuration);
    Board board("pl");
  });
  BOOST_TEST(message ==
             "pl.detector.threshold: '300' (board.yaml:3) is out of range: allowed is 0 to 255");
}

BOOST_AUTO_TEST_CASE(limits_that_are_only_the_type_s_are_not_documented) {
  const Configuration::Scope scope(configuration);
  Parameter<std::uint64_t> free("free", 1, Unit::cycles, Source::assumed, "");
  Parameter<std::uint64_t> positive("positive", 1, Unit::cycles, {1}, Source::assumed, "");
  Parameter<std::int32_t> both("both", 1, Unit::cycles, {-1, 8}, Source::assumed, "");
  Parameter<double> real("real", 1, Unit::length, {0.5}, Source::assumed, "");
  std::vector<std::string> allowed;
  for (const auto& parameter : configuration.parameters()) allowed.push_back(parameter.allowed);
  const std::vector<std::string> expected{"", "at least 1 cycles", "-1 cycles to 8 cycles",
                                          "at least 500 mm"};
  BOOST_TEST(allowed == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_default_out_of_range_is_a_mistake_in_the_code) {
  const auto build = [] {
    Parameter<int> wrong("wrong", 9, Unit::none, {0, 8}, Source::assumed, "");
  };
  BOOST_CHECK_THROW(build(), std::logic_error);
}

BOOST_AUTO_TEST_CASE(a_default_that_is_no_choice_is_a_mistake_in_the_code) {
  const auto text = [] {
    Parameter<std::string> wrong("wrong", "c", {"a", "b"}, Source::assumed, "");
  };
  const auto choice = [] {
    Parameter<Fidelity> wrong("wrong", Fidelity::tlm, {{"clocked", Fidelity::clocked}},
                              Source::assumed, "");
  };
  BOOST_CHECK_THROW(text(), std::logic_error);
  BOOST_CHECK_THROW(choice(), std::logic_error);
}

BOOST_AUTO_TEST_CASE(two_of_one_name_are_a_mistake_in_the_code) {
  sc_core::sc_report_handler::set_actions(sc_core::SC_WARNING, sc_core::SC_DO_NOTHING);
  Parameter<int> first("twin", 1, Unit::none, Source::assumed, "");
  const auto second = [] { Parameter<int> again("twin", 1, Unit::none, Source::assumed, ""); };
  BOOST_CHECK_THROW(second(), std::logic_error);
  sc_core::sc_report_handler::set_actions(sc_core::SC_WARNING, sc_core::SC_DEFAULT_WARNING_ACTIONS);
}

BOOST_AUTO_TEST_SUITE_END()
