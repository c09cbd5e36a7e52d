// What estimates take from the figures of synthesis: between them, beyond them, and within what is
// known otherwise.
#include <fpga/synthesis/known_figures.h>
#include <fpga/synthesis/synthesis.h>
#include <host/digest.h>

#include <boost/test/unit_test.hpp>
#include <cstdint>

#include <vp/error.h>

#include "temporary_files.h"

using namespace platform::synthesis;

namespace {

constexpr std::uint64_t mhz = 1'000'000;

const char* const simple = R"({"version": 1, "tool": "Yosys 0.23", "entries": [
  {"ip": "tree", "parameters": {"LABELS": 16}, "lut": 85, "lut_memory": 10, "lut_through": 5, "ff": 50, "ramb18": 1,
   "ramb36": 0, "dsp": 0, "fmax_mhz": {"low": 60, "nominal": 80, "high": 120}},
  {"ip": "tree", "parameters": {"LABELS": 64}, "lut": 270, "lut_memory": 20, "lut_through": 10, "ff": 250, "ramb18": 1,
   "ramb36": 1, "dsp": 2, "fmax_mhz": {"low": 50, "nominal": 70, "high": 90}},
  {"ip": "wires", "parameters": {}, "lut": 5, "lut_memory": 0, "lut_through": 0, "ff": 0, "ramb18": 0, "ramb36": 0,
   "dsp": 0}]})";

KnownFigures figures(const std::string& text = simple) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "synthesis.json", text);
  return KnownFigures::load(folder / "synthesis.json");
}

vp::IpEstimate tree(std::int64_t labels) {
  vp::IpEstimate e;
  e.rtl = {"tree", {{"LABELS", labels}, {"WIDTH", 640}}, {}};
  return e;
}

vp::IpEstimate applied(vp::IpEstimate e) {
  figures().apply(e, "pl.tree");
  return e;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(known_figures)

BOOST_AUTO_TEST_CASE(a_point_is_taken_as_it_is) {
  const vp::IpEstimate e = applied(tree(64));
  BOOST_TEST(e.lut == 300u);
  BOOST_TEST(e.ff == 250u);
  BOOST_TEST(e.bram36 == 1.5);
  BOOST_TEST(e.dsp == 2u);
  BOOST_TEST(e.fmax_hz == 50 * mhz);
  BOOST_TEST(e.fmax_high_hz == 90 * mhz);
  BOOST_TEST((e.fmax_origin == vp::FmaxOrigin::synthesised));
  BOOST_TEST(e.uncertainty_percent == 40u);
  BOOST_TEST(e.source == "synthesised from its RTL (Yosys 0.23), LABELS=64");
}

// Whatever else was synthesised only for one of them.
BOOST_AUTO_TEST_CASE(the_number_of_pixels_a_clock_counts_first) {
  const KnownFigures known = figures(R"({"version": 1, "tool": "Yosys 0.23", "entries": [
    {"ip": "pixels", "parameters": {"LABELS": 16, "PIXELS_PER_CLOCK": 1}, "lut": 10, "lut_memory": 0,
     "lut_through": 0, "ff": 1, "ramb18": 0, "ramb36": 0, "dsp": 0},
    {"ip": "pixels", "parameters": {"LABELS": 64, "PIXELS_PER_CLOCK": 4}, "lut": 40, "lut_memory": 0,
     "lut_through": 0, "ff": 4, "ramb18": 0, "ramb36": 0, "dsp": 0}]})");
  const auto lut = [&known](std::int64_t labels, std::int64_t pixels) {
    return known.find({"pixels", {{"LABELS", labels}, {"PIXELS_PER_CLOCK", pixels}}, {}})->lut;
  };
  BOOST_TEST(lut(16, 4) == 40);
  BOOST_TEST(lut(64, 1) == 10);
}

BOOST_AUTO_TEST_CASE(between_two_points_counts_are_on_a_line_and_fmax_is_in_both_ranges) {
  const vp::IpEstimate e = applied(tree(40));
  BOOST_TEST(e.lut == 200u);
  BOOST_TEST(e.ff == 150u);
  BOOST_TEST(e.bram36 == 1.0);
  BOOST_TEST(e.dsp == 1u);
  BOOST_TEST(e.fmax_hz == 50 * mhz);
  BOOST_TEST(e.fmax_high_hz == 120 * mhz);
  BOOST_TEST(has(e.source, "between LABELS=16 and LABELS=64"), e.source);
}

BOOST_AUTO_TEST_CASE(beyond_them_the_line_goes_on_and_less_is_known) {
  const vp::IpEstimate more = applied(tree(256));  // eight levels after six
  BOOST_TEST(more.lut == 1100u);
  BOOST_TEST(more.fmax_hz == 50 * mhz * 6 / 8);
  BOOST_TEST(more.fmax_high_hz == 90 * mhz);
  BOOST_TEST(more.uncertainty_percent == 60u);
  BOOST_TEST(has(more.source, "continued from LABELS=16 and LABELS=64"), more.source);
  const vp::IpEstimate fewer = applied(tree(4));
  BOOST_TEST(fewer.lut == 50u);
  BOOST_TEST(fewer.ff == 0u);
}

// Of LABELS=16 there is no frame of 1280: what was synthesised for that width is nearer than a line
// through frames of another.
BOOST_AUTO_TEST_CASE(a_value_that_was_synthesised_comes_before_a_line_over_another_parameter) {
  const std::string entries =
      R"({"version": 1, "tool": "Yosys 0.23", "entries": [)"
      R"({"ip": "tree", "parameters": {"LABELS": 16, "WIDTH": 640}, "lut": 100,)"
      R"( "lut_memory": 0, "lut_through": 0, "ff": 0, "ramb18": 0, "ramb36": 0, "dsp": 0},)"
      R"({"ip": "tree", "parameters": {"LABELS": 64, "WIDTH": 640}, "lut": 200,)"
      R"( "lut_memory": 0, "lut_through": 0, "ff": 0, "ramb18": 0, "ramb36": 0, "dsp": 0},)"
      R"({"ip": "tree", "parameters": {"LABELS": 64, "WIDTH": 1280}, "lut": 300,)"
      R"( "lut_memory": 0, "lut_through": 0, "ff": 0, "ramb18": 0, "ramb36": 0, "dsp": 0}]})";
  const KnownFigures two = figures(entries);
  const auto lut = [&](std::int64_t labels, std::int64_t width) {
    return two.find({"tree", {{"LABELS", labels}, {"WIDTH", width}}, {}})->lut;
  };
  BOOST_TEST(lut(64, 1280) == 300);
  BOOST_TEST(lut(64, 960) == 250);
  BOOST_TEST(lut(40, 640) == 150);
  BOOST_TEST(lut(40, 1280) == 300);
}

BOOST_AUTO_TEST_CASE(limits_that_are_known_otherwise_hold) {
  vp::IpEstimate both = tree(64);
  both.fmax_hz = both.fmax_high_hz = 55 * mhz;
  both.fmax_origin = vp::FmaxOrigin::published;
  both.fmax_documentation = "a user measured it";
  both = applied(both);
  BOOST_TEST(both.fmax_hz == 55 * mhz);
  BOOST_TEST(both.fmax_high_hz == 55 * mhz);
  BOOST_TEST((both.fmax_origin == vp::FmaxOrigin::published));
  BOOST_TEST(has(both.fmax_documentation, "a user measured it; "), both.fmax_documentation);
  BOOST_TEST(has(both.fmax_documentation, "50 to 90 MHz"), both.fmax_documentation);

  vp::IpEstimate low = tree(64);
  low.fmax_hz = 100 * mhz;
  low = applied(low);
  BOOST_TEST(low.fmax_hz == 100 * mhz);
  BOOST_TEST(low.fmax_high_hz == 100 * mhz);

  vp::IpEstimate high = tree(64);
  high.fmax_high_hz = 40 * mhz;
  high = applied(high);
  BOOST_TEST(high.fmax_hz == 40 * mhz);
  BOOST_TEST(high.fmax_high_hz == 40 * mhz);

  vp::IpEstimate memory = tree(64);
  memory.bram36 = 3;
  BOOST_TEST(applied(memory).bram36 == 3.0);
}

BOOST_AUTO_TEST_CASE(size_is_that_against_the_module_whose_power_was_measured) {
  vp::IpEstimate e = tree(64);
  e.rtl.measured = {{"LABELS", 16}};
  BOOST_TEST(applied(e).size == 3.0);
}

BOOST_AUTO_TEST_CASE(without_a_path_and_without_figures_the_own_ones_stay) {
  vp::IpEstimate wires;
  wires.rtl.module = "wires";
  wires.fmax_hz = 100 * mhz;
  wires = applied(wires);
  BOOST_TEST(wires.lut == 5u);
  BOOST_TEST(wires.fmax_hz == 100 * mhz);
  BOOST_TEST((wires.fmax_origin == vp::FmaxOrigin::estimated));
  vp::IpEstimate other;
  other.lut = 7;
  BOOST_TEST(applied(other).lut == 7u);
  other.rtl.module = "unknown";
  BOOST_TEST(applied(other).lut == 7u);
}

BOOST_AUTO_TEST_CASE(a_file_of_another_kind_is_refused) {
  for (const char* text : {"{}", "[]", R"({"tool": 1, "entries": []})",
                           R"({"tool": "x", "entries": [{"ip": "a"}]})"}) {
    BOOST_CHECK_EXCEPTION(figures(text), vp::InputError, [](const vp::InputError& error) {
      return has(error.what(), "markervp rtl synth --output");
    });
  }
}

namespace {

/// RTL of a user in the place of a tree whose model says other things.
struct Mine {
  Mine() { kit::write_file(folder / "mine.json", text("aaa", 640)); }

  static std::string text(const std::string& hash, int width) {
    return R"({"version": 1, "tool": "Yosys 0.23", "entries": [{"ip": "mine", "parameters": {},)"
           R"( "built_with": {"WIDTH": )" +
           std::to_string(width) + R"(}, "sources": {"mine.sv": ")" + hash +
           R"("}, "lut": 100, "lut_memory": 0, "lut_through": 55, "ff": 20, "ramb18": 0, "ramb36": 2,)"
           R"( "dsp": 1, "fmax_mhz": {"low": 97, "nominal": 120, "high": 176}}]})";
  }
  vp::IpEstimate estimate() const {
    vp::IpEstimate e = tree(64);
    e.kind = "tree";
    e.bram36 = 9;
    e.size = 7;
    e.fmax_hz = e.fmax_high_hz = 55 * mhz;
    e.foreign.file = folder / "mine.so";
    e.known = false;  // as of a part that is no IP of ours
    e.foreign.sources = {"bbb", "aaa"};
    e.foreign.parameters = {{"WIDTH", 640}, {"LABELS", 64}};
    return e;
  }
  vp::IpEstimate applied(const std::string& figures_file = "") const {
    vp::IpEstimate e = estimate();
    e.foreign.figures = figures_file;
    figures().apply(e, "pl.tree");
    return e;
  }

  kit::TemporaryFolder folder;
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(of_a_users_rtl_nothing_is_known_by_itself, Mine) {
  const vp::IpEstimate e = applied();
  BOOST_TEST(!e.known);
  BOOST_TEST(e.lut + e.ff + e.dsp == 0u);
  BOOST_TEST(e.bram36 == 0);
  BOOST_TEST(e.fmax_hz == 0u);
  for (const char* part : {"mine.so", "rtl synth --rtl DIR", "--set pl.tree.figures=FILE"})
    BOOST_TEST(has(e.source, part), e.source);
}

BOOST_FIXTURE_TEST_CASE(a_users_rtl_has_the_figures_of_its_own_synthesis, Mine) {
  const auto check = [](const vp::IpEstimate& e) {
    BOOST_TEST(e.known);
    BOOST_TEST(e.lut == 155u);
    BOOST_TEST(e.ff == 20u);
    BOOST_TEST(e.bram36 == 2.0);
    BOOST_TEST(e.dsp == 1u);
    BOOST_TEST(e.size == 1.0);
    BOOST_TEST(e.kind == "", "no coefficient of the thesis' IP");
    BOOST_TEST(e.fmax_hz == 97 * mhz);
    BOOST_TEST(e.fmax_high_hz == 176 * mhz);
    BOOST_TEST(has(e.source, "mine.so"), e.source);
  };
  check(applied(folder / "mine.json"));
  kit::write_file(folder / "mine.figures.json", text("aaa", 640));
  check(applied());
}

BOOST_FIXTURE_TEST_CASE(figures_of_other_sources_or_parameters_are_not_taken, Mine) {
  const auto refused = [this](const std::string& text, const std::string& why) {
    kit::write_file(folder / "mine.json", text);
    BOOST_CHECK_EXCEPTION(applied(folder / "mine.json"), vp::InputError,
                          [&](const vp::InputError& error) {
                            return has(error.what(), "pl.tree.figures") && has(error.what(), why);
                          });
    // That beside the object may be an old one.
    kit::write_file(folder / "mine.figures.json", text);
    const vp::IpEstimate e = applied();
    BOOST_TEST(!e.known);
    BOOST_TEST(has(e.source, why), e.source);
  };
  refused(text("ccc", 640), "mine.sv is not one of the sources");
  refused(text("aaa", 320), "WIDTH is 320 there, and 640 in the object");
  refused(simple, "does not say which sources");
}

// Built by the user as it is installed, with parameters of its own.
BOOST_FIXTURE_TEST_CASE(the_rtl_that_comes_along_is_recognised, Mine) {
  const auto lut = [this](std::uint64_t lean, bool changed = false) {
    vp::IpEstimate e = estimate();
    e.rtl = {"corner_detection", {{"LEAN", 0}}, {}};
    e.foreign.sources.clear();
    const auto designs = own_designs({"corner_detection"});
    for (const auto& source : designs.front().sources)
      e.foreign.sources.push_back(platform::host::file_hash(source.string()));
    if (changed) e.foreign.sources.front() = "of another text";
    e.foreign.parameters = {{"LEAN", lean}, {"WIDTH", 640}};
    KnownFigures::load(MARKERVP_DATA "/rtl/synthesis.json").apply(e, "pl.corner_detection");
    return e.lut;
  };
  BOOST_TEST(lut(0) > 4000u);
  BOOST_TEST(lut(1) < 1000u);
  BOOST_TEST(lut(1) > 500u);
  BOOST_TEST(lut(0, true) == 0u);
}

// What the models compute themselves is what synthesis makes of it.
BOOST_AUTO_TEST_CASE(block_memories_of_the_defaults) {
  const KnownFigures committed = KnownFigures::load(MARKERVP_DATA "/rtl/synthesis.json");
  BOOST_TEST(committed.find({"corner_detection", {{"LEAN", 0}}, {}})->bram36 == 4.0);
  BOOST_TEST(committed.find({"blob_detection", {{"LABELS", 128}}, {}})->bram36 == 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
