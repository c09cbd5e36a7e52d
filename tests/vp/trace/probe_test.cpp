#include <vp/probe.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <vector>

#include "simulation.h"

namespace {

enum class Colour : std::uint16_t { red = 3, green = 500 };

double number(std::uint64_t bits) {
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(probe, kit::Simulation)

BOOST_AUTO_TEST_CASE(shows_the_value_as_it_stands) {
  std::uint8_t value = 7;
  const vp::Probe<std::uint8_t> probe("value", value, 5);
  BOOST_TEST(probe.bits() == 7u);
  value = 31;
  BOOST_TEST(probe.bits() == 31u);
  BOOST_TEST(probe.width() == 5u);
  BOOST_TEST(probe.address() == &value);
  BOOST_TEST(probe.byte_count() == 1u);
  BOOST_TEST(!probe.is_real());
  BOOST_TEST(probe.name() == std::string("value"));
}

BOOST_AUTO_TEST_CASE(widths_come_from_the_type) {
  const bool flag = true;
  const Colour colour = Colour::green;
  const std::int32_t negative = -2;
  BOOST_TEST(vp::Probe<bool>("flag", flag).width() == 1u);
  const vp::Probe<Colour> colour_probe("colour", colour);
  BOOST_TEST(colour_probe.width() == 16u);
  BOOST_TEST(colour_probe.bits() == 500u);
  const vp::Probe<std::int32_t> negative_probe("negative", negative);
  BOOST_TEST((negative_probe.bits() & 0xffffffffu) == 0xfffffffeu);
}

BOOST_AUTO_TEST_CASE(real_numbers_give_the_pattern_of_a_double) {
  const double exact = 0.1;
  const float coarse = 0.25f;
  const vp::Probe<double> exact_probe("exact", exact);
  BOOST_TEST(exact_probe.is_real());
  BOOST_TEST(number(exact_probe.bits()) == 0.1);
  const vp::Probe<float> coarse_probe("coarse", coarse);
  BOOST_TEST(number(coarse_probe.bits()) == 0.25);
  BOOST_TEST(coarse_probe.address() == nullptr);
}

BOOST_AUTO_TEST_CASE(a_getter_is_called_when_asked) {
  int calls = 0;
  const vp::Probe<std::uint32_t> probe(
      "sum", [&calls]() -> std::uint32_t { return 40 + ++calls; }, 8);
  BOOST_TEST(calls == 0);
  BOOST_TEST(probe.bits() == 41u);
  BOOST_TEST(probe.address() == nullptr);
}

BOOST_AUTO_TEST_CASE(arrays_are_numbered_from_0) {
  const std::array<std::uint16_t, 3> values = {10, 20, 30};
  const vp::ProbeArray<std::uint16_t> probes("line", values, 12);
  BOOST_TEST(probes.size() == 3u);
  BOOST_TEST(probes[0].name() == std::string("line_0"));
  BOOST_TEST(probes[2].name() == std::string("line_2"));
  BOOST_TEST(probes[2].bits() == 30u);
  BOOST_TEST(probes[2].width() == 12u);

  const vp::ProbeArray<std::uint16_t> part("part", values.data() + 1, 2);
  BOOST_TEST(part.size() == 2u);
  BOOST_TEST(part[0].bits() == 20u);

  struct Pair {
    bool valid;
    std::uint8_t label;
  };
  const std::vector<Pair> pairs = {{true, 5}, {false, 9}};
  const vp::ProbeArray<std::uint8_t> labels(
      "label", pairs.size(), [&pairs](std::size_t i) { return pairs[i].label; }, 7);
  BOOST_TEST(labels[1].bits() == 9u);
}

BOOST_AUTO_TEST_SUITE_END()
