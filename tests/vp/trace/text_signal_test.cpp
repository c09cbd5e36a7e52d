// Texts in traces.
#include <boost/test/unit_test.hpp>

#include "counter_platform.h"
#include "wave_kit.h"

BOOST_FIXTURE_TEST_SUITE(text_signal, TraceFixture)

BOOST_AUTO_TEST_CASE(a_text_follows_its_source_and_costs_nothing_untraced) {
  unsigned asked = 0;
  std::vector<std::unique_ptr<vp::TextSignal>> texts;
  {
    Platform platform(options, 1000);
    texts.push_back(std::make_unique<vp::TextSignal>(
        "parity",
        [&] {
          ++asked;
          return platform.fast.odd ? "odd one" : "even";
        },
        std::vector<vp::SignalBase*>{&platform.fast.odd}));
    sc_core::sc_start(vp::from_ps(25'000));
    texts.front()->touch();
    sc_core::sc_start(vp::from_ps(10'000));
    platform.tracer.close();
    const unsigned before = asked;
    texts.front()->touch();
    BOOST_TEST(asked == before);
  }
  const WaveText text(options.file.string());
  BOOST_TEST(text.value("parity", 0) == "even");
  BOOST_TEST(text.value("parity", 10'000) == "odd one");
  BOOST_TEST(text.value("parity", 20'000) == "even");
  BOOST_TEST(text.value("parity", 30'000) == "odd one");
}

BOOST_AUTO_TEST_SUITE_END()
