// Both fidelities and mixtures of them are the same from outside, to the picosecond, whatever
// happens in the middle of a frame or of a burst.
#include <boost/test/unit_test.hpp>

#include <vp/error.h>

#include "disturbed_logic.h"

namespace {

using kit::DisturbedLogic;
using pl::Fidelity;
using Lines = std::vector<std::string>;

constexpr DisturbedLogic::Size small{128, 64};
constexpr unsigned actions = 150;

Lines clocked(std::uint64_t seed, const Lines& settings = {}) {
  return DisturbedLogic(Fidelity::clocked, small, settings).run(seed, actions);
}

/// Empty if both saw the same; else where they part.
std::string first_difference(const Lines& a, const Lines& b) {
  for (std::size_t i = 0; i < a.size() || i < b.size(); ++i) {
    const std::string left = i < a.size() ? a[i] : "the end",
                      right = i < b.size() ? b[i] : "the end";
    if (left != right) {
      return "line " + std::to_string(i) + ": " + left + " | " + right +
             (i > 0 ? ", after " + a[i - 1] : "");
    }
  }
  return "";
}

std::size_t count(const Lines& lines, const std::string& part) {
  std::size_t found = 0;
  for (const std::string& line : lines) found += line.find(part) != std::string::npos;
  return found;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fidelity)

BOOST_AUTO_TEST_CASE(tlm_is_clocked_whatever_happens) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      const Lines tlm = DisturbedLogic(Fidelity::tlm, small).run(seed, actions);
      BOOST_TEST(first_difference(tlm, clocked(seed)) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_differs_where_labels_and_buffers_run_out) {
  const Lines settings{"pl.blob_detection.label_count=4", "pl.blob_detection.minimum_side=1 px",
                       "pl.feature_packaging.buffer_depth=2",
                       "pl.axi_threshold_bridge.fifo_depth=1"};
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      const Lines tlm = DisturbedLogic(Fidelity::tlm, small, settings).run(seed, actions);
      BOOST_TEST(first_difference(tlm, clocked(seed, settings)) == "");
    }
  }
}

BOOST_AUTO_TEST_CASE(the_scripts_reach_what_they_are_for) {
  Lines all;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Lines lines = DisturbedLogic(Fidelity::tlm, small).run(seed, actions);
    all.insert(all.end(), lines.begin(), lines.end());
  }
  BOOST_TEST(count(all, "frame_ena = 1") > 20u);
  BOOST_TEST(count(all, "corner_out = 1") > 100u);
  BOOST_TEST(count(all, "active_threshold") > 20u);
  BOOST_TEST(count(all, "pl.concat") > 50u);
  BOOST_TEST(count(all, "feature_packaging.feature") > 50u);
}

BOOST_AUTO_TEST_CASE(mixtures_are_clocked_too) {
  const std::vector<Lines> mixtures = {
      {"pl.fidelity.sensor_input=clocked"},
      {"pl.fidelity.corner_detection=clocked"},
      {"pl.fidelity.blob_detection=clocked"},
      {"pl.fidelity.axi_threshold_bridge=clocked"},
      {"pl.fidelity.axi_image_store=clocked"},
      {"pl.fidelity.corner_detection=clocked", "pl.fidelity.axi_image_store=clocked"},
  };
  for (const Lines& settings : mixtures) {
    for (std::uint64_t seed = 50; seed < 55; ++seed) {
      BOOST_TEST_CONTEXT(settings[0] << ", seed " << seed) {
        const Lines mixed = DisturbedLogic(Fidelity::tlm, small, settings).run(seed, actions);
        BOOST_TEST(first_difference(mixed, clocked(seed)) == "");
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_clocked_detector_makes_the_sensor_clocked) {
  const Lines settings{"pl.fidelity.corner_detection=clocked", "pl.fidelity.sensor_input=tlm"};
  BOOST_CHECK_THROW(DisturbedLogic(Fidelity::tlm, small, settings), vp::InputError);
}

BOOST_AUTO_TEST_CASE(threshold_and_blobs_are_of_one_kind) {
  BOOST_CHECK_THROW(DisturbedLogic(Fidelity::tlm, small, {"pl.fidelity.global_threshold=clocked"}),
                    vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
