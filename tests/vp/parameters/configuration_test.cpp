#include <vp/configuration.h>
#include <vp/parameter.h>

#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "input_error.h"
#include "simulation.h"

using vp::Configuration;
using vp::Parameter;
using vp::Source;
using vp::Unit;

namespace {

struct Leaf : sc_core::sc_module {
  explicit Leaf(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  Parameter<std::uint32_t> threshold{
      "threshold", 30, Unit::none, {0, 255}, Source::decision, "contrast of a corner"};
};

struct Fabric : sc_core::sc_module {
  explicit Fabric(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  Leaf corner_detection{"corner_detection"};
  Leaf blob_detection{"blob_detection"};
  Parameter<std::uint64_t> clock{"clock", 50'000'000, Unit::frequency, Source::published,
                                 "pixel clock"};
  Parameter<double> offset{"offset", -3.5, Unit::angle, Source::assumed, "tilt of the camera"};
  Parameter<std::string> note{"note", "", Source::decision, "free text"};
};

/// A configuration with some settings, and a platform built in it and gone again.
struct Fixture : kit::Simulation {
  Configuration configuration;

  void build(Configuration& with) {
    const Configuration::Scope scope(with);
    Fabric fabric("pl");
  }
  void build() { build(configuration); }

  std::string unused() {
    build();
    return input_error([this] { configuration.check_unused(); });
  }
};

struct TemporaryFile {
  std::string path;

  explicit TemporaryFile(const std::string& text)
      : path((std::filesystem::temp_directory_path() / "markervp_configuration_test.yaml")
                 .string()) {
    std::ofstream(path) << text;
  }
  ~TemporaryFile() { std::remove(path.c_str()); }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(configuration_, Fixture)

BOOST_AUTO_TEST_CASE(later_files_win_and_set_wins_over_files) {
  configuration.set("a=set");
  configuration.load_text("a: one\nb: one\nc: one", "one.yaml");
  configuration.load_text("a: two\nb: two", "two.yaml");
  BOOST_TEST(configuration.find("a")->text == "set");
  BOOST_TEST(configuration.find("a")->origin == "--set");
  BOOST_TEST(configuration.find("b")->text == "two");
  BOOST_TEST(configuration.find("b")->origin == "two.yaml:2");
  BOOST_TEST(configuration.find("c")->text == "one");
  BOOST_TEST(configuration.find("d") == nullptr);
}

BOOST_AUTO_TEST_CASE(the_last_set_wins) {
  configuration.set("pl.clock=1 MHz");
  configuration.set("pl.clock = 2 MHz ");
  BOOST_TEST(configuration.find("pl.clock")->text == "2 MHz");
}

BOOST_AUTO_TEST_CASE(a_set_without_value_or_key_is_refused) {
  BOOST_TEST(input_error([this] { configuration.set("pl.clock"); }) ==
             "--set 'pl.clock': write path=value, such as --set pl.width='320 px'");
  BOOST_TEST(input_error([this] { configuration.set("=5"); }) ==
             "'' (--set) is not a key: write a name, or names joined by dots, of at most 500 "
             "characters");
  BOOST_TEST(
      input_error([this] { configuration.set("pl..clock=5"); }) ==
      "'pl..clock' (--set) is not a key: write a name, or names joined by dots, of at most 500 "
      "characters");
}

BOOST_AUTO_TEST_CASE(files_are_read) {
  const TemporaryFile file("pl:\n  clock: 27 MHz\n");
  configuration.load_file(file.path);
  BOOST_TEST(configuration.find("pl.clock")->text == "27 MHz");
  BOOST_TEST(configuration.find("pl.clock")->origin == file.path + ":2");
}

BOOST_AUTO_TEST_CASE(a_missing_file_and_a_folder_are_refused) {
  BOOST_TEST(input_error([this] { configuration.load_file("/nowhere/a.yaml"); }) ==
             "cannot read configuration '/nowhere/a.yaml': No such file or directory");
  BOOST_TEST(input_error([this] { configuration.load_file("/"); }) ==
             "cannot read configuration '/': it is a folder: name a file");
}

BOOST_AUTO_TEST_CASE(a_file_with_an_error_changes_nothing) {
  configuration.load_text("a: 1", "one.yaml");
  input_error([this] { configuration.load_text("a: 2\nb: [", "two.yaml"); });
  BOOST_TEST(configuration.find("a")->text == "1");
}

BOOST_AUTO_TEST_CASE(known_keys_are_used) {
  configuration.set("pl.corner_detection.threshold=31");
  BOOST_TEST(unused() == "nothing thrown");
}

BOOST_AUTO_TEST_CASE(an_unknown_key_names_the_nearest) {
  configuration.load_text("pl:\n  corner_detecton:\n    threshold: 31", "board.yaml");
  BOOST_TEST(unused() ==
             "unknown key 'pl.corner_detecton.threshold' (board.yaml:3): did you mean "
             "'pl.corner_detection.threshold'?");
}

BOOST_AUTO_TEST_CASE(a_key_in_the_wrong_place_is_found_by_its_last_part) {
  configuration.set("clock=31 MHz");
  BOOST_TEST(unused() == "unknown key 'clock' (--set): did you mean 'pl.clock'?");
}

BOOST_AUTO_TEST_CASE(an_unknown_key_without_a_near_one) {
  configuration.set("resolution=640 px");
  BOOST_TEST(unused() ==
             "unknown key 'resolution' (--set): the configuration has nothing like it; `markervp "
             "config` prints its keys");
}

BOOST_AUTO_TEST_CASE(a_module_is_not_a_parameter) {
  configuration.set("pl.blob_detection=3");
  BOOST_TEST(unused() ==
             "unknown key 'pl.blob_detection' (--set): it is a group of parameters, such as "
             "'pl.blob_detection.threshold'");
}

BOOST_AUTO_TEST_CASE(all_unknown_keys_are_named) {
  configuration.load_text("pl.clok: 1 MHz", "board.yaml");
  configuration.set("pl.noet=a");
  BOOST_TEST(unused() ==
             "unknown key 'pl.clok' (board.yaml:1): did you mean 'pl.clock'?; "
             "unknown key 'pl.noet' (--set): did you mean 'pl.note'?");
}

BOOST_AUTO_TEST_CASE(scopes_nest_and_end) {
  BOOST_TEST(Configuration::current() == nullptr);
  {
    const Configuration::Scope outer(configuration);
    Configuration other;
    {
      const Configuration::Scope inner(other);
      BOOST_TEST(Configuration::current() == &other);
    }
    BOOST_TEST(Configuration::current() == &configuration);
  }
  BOOST_TEST(Configuration::current() == nullptr);
}

BOOST_AUTO_TEST_CASE(a_module_stands_before_its_submodules) {
  build();
  std::vector<std::string> paths;
  for (const auto& parameter : configuration.parameters()) paths.push_back(parameter.path);
  const std::vector<std::string> expected{"pl.clock", "pl.offset", "pl.note",
                                          "pl.corner_detection.threshold",
                                          "pl.blob_detection.threshold"};
  BOOST_TEST(paths == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(prints_the_effective_tree) {
  configuration.set("pl.corner_detection.threshold=31");
  build();
  BOOST_TEST(configuration.to_yaml() ==
             "pl:\n"
             "  clock: 50 MHz                                   # pixel clock (published)\n"
             "  offset: -3.5 deg                                # tilt of the camera (assumed)\n"
             "  note: \"\"                                        # free text (decision)\n"
             "  corner_detection:\n"
             "    threshold: 31                                 # contrast of a corner (decision; "
             "0 to 255; default 30)\n"
             "  blob_detection:\n"
             "    threshold: 30                                 # contrast of a corner (decision; "
             "0 to 255)\n");
}

/// Two clocks of which the second, and a whole group, follow the first.
struct Divided : sc_core::sc_module {
  struct Outputs : sc_core::sc_module {
    Outputs(const sc_core::sc_module_name& name, std::uint64_t hz)
        : sc_core::sc_module(name), rate("rate", hz / 4, Unit::frequency, Source::derived, "out") {
      rate.follows("clocks.fast");
    }
    Parameter<std::uint64_t> rate;
  };
  explicit Divided(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {
    slow.follows("clocks.fast");
  }
  Parameter<std::uint64_t> fast{"fast", 100'000'000, Unit::frequency, Source::decision, "in"};
  Parameter<std::uint64_t> slow{"slow", fast / 2, Unit::frequency, Source::derived, "half"};
  Outputs outputs{"outputs", fast};
};

std::string printed_divided(Configuration& configuration) {
  const kit::Simulation fresh;
  const Configuration::Scope scope(configuration);
  const Divided divided("clocks");
  return configuration.to_yaml();
}

BOOST_AUTO_TEST_CASE(a_default_that_follows_is_shown_but_not_pinned) {
  const std::string printed = printed_divided(configuration);
  BOOST_TEST(printed ==
             "clocks:\n"
             "  fast: 100 MHz                                   # in (decision)\n"
             "  # slow: 50 MHz                                  # half (derived; follows "
             "clocks.fast)\n"
             "  # outputs:\n"
             "    # rate: 25 MHz                                # out (derived; follows "
             "clocks.fast)\n");
  Configuration again;
  again.load_text(printed, "printed.yaml");
  again.set("clocks.fast=80 MHz");
  again.set("clocks.outputs.rate=1 MHz");
  BOOST_TEST(printed_divided(again) ==
             "clocks:\n"
             "  fast: 80 MHz                                    # in (decision; default 100 MHz)\n"
             "  # slow: 40 MHz                                  # half (derived; follows "
             "clocks.fast)\n"
             "  outputs:\n"
             "    rate: 1 MHz                                   # out (derived; follows "
             "clocks.fast; default 20 MHz)\n");
}

BOOST_AUTO_TEST_CASE(the_printed_tree_reads_back) {
  configuration.set("pl.clock=33.333333 MHz");
  configuration.set("pl.note", "null: # \"quoted\" \\ \t\x01 text, \u00b5");
  build();
  Configuration again;
  again.load_text(configuration.to_yaml(), "printed.yaml");
  const kit::Simulation fresh;
  build(again);
  BOOST_CHECK_NO_THROW(again.check_unused());
  BOOST_TEST(again.to_yaml() == configuration.to_yaml());
  BOOST_TEST((again.values() == configuration.values()));
  BOOST_TEST(again.hash() == configuration.hash());
}

BOOST_AUTO_TEST_CASE(values_are_a_flat_map) {
  build();
  const std::map<std::string, std::string> expected{{"pl.blob_detection.threshold", "30"},
                                                    {"pl.clock", "50 MHz"},
                                                    {"pl.corner_detection.threshold", "30"},
                                                    {"pl.note", ""},
                                                    {"pl.offset", "-3.5 deg"}};
  BOOST_TEST((configuration.values() == expected));
}

BOOST_AUTO_TEST_CASE(the_hash_depends_on_values_only) {
  build();
  configuration.set("pl.clock=0.05 GHz");  // the default, written otherwise
  Configuration same;
  same.set("pl.clock=0.05 GHz");
  const kit::Simulation second;
  build(same);
  BOOST_TEST(same.hash() == configuration.hash());
  BOOST_TEST(same.hash().size() == 16u);

  Configuration other;
  other.set("pl.clock=51 MHz");
  const kit::Simulation third;
  build(other);
  BOOST_TEST(other.hash() != configuration.hash());
}

BOOST_AUTO_TEST_CASE(the_hash_is_the_same_on_every_host) {
  BOOST_TEST(Configuration().hash() == "cbf29ce484222325");  // FNV-1a's offset basis
  Configuration one;
  one.add({"a", "1", "1", "", Source::assumed, ""});
  BOOST_TEST(one.hash() == "ac4d51820e249a1d");
}

BOOST_AUTO_TEST_CASE(descriptions_outlive_the_platform) {
  auto own = std::make_unique<Configuration>();
  build(*own);
  BOOST_TEST(own->parameters().at(3).documentation == "contrast of a corner");
  BOOST_TEST(own->parameters().at(3).allowed == "0 to 255");
  BOOST_TEST(vp::to_string(own->parameters().at(3).source) == "decision");
}

BOOST_AUTO_TEST_SUITE_END()
