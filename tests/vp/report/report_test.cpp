#include <vp/report.h>

#include <boost/test/unit_test.hpp>
#include <memory>
#include <sstream>

#include "simulation.h"

namespace {

struct Dma : sc_core::sc_module {
  SC_HAS_PROCESS(Dma);
  explicit Dma(sc_core::sc_module_name name) : sc_core::sc_module(name) { SC_THREAD(run); }
  void run() {
    wait(sc_core::sc_time(12'345, sc_core::SC_NS));
    if (action) action();
  }
  std::function<void()> action;
};

struct Fixture : kit::Simulation {
  std::ostringstream out;
  std::unique_ptr<vp::ReportRouter> router = std::make_unique<vp::ReportRouter>();
  Dma dma{"dma"};

  Fixture() { router->redirect(out); }
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const sc_core::sc_report& report) {
    return report.get_msg();
  }
  return "nothing thrown";
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(report, Fixture)

BOOST_AUTO_TEST_CASE(a_warning_is_one_line_with_name_and_time) {
  dma.action = [this] { vp::warn(dma, "/markervp/axi_dma/length", "length is zero,\nignored"); };
  sc_core::sc_start();
  BOOST_TEST(out.str() ==
             "warning: dma: length is zero, ignored [/markervp/axi_dma/length] at 12.345 us\n");
}

BOOST_AUTO_TEST_CASE(warnings_are_kept_and_counted) {
  dma.action = [this] { vp::warn(dma, "/markervp/axi_dma/length", "length is zero"); };
  sc_core::sc_start();
  BOOST_REQUIRE(router->warnings().size() == 1u);
  const vp::Warning& warning = router->warnings().front();
  BOOST_TEST(warning.id == "/markervp/axi_dma/length");
  BOOST_TEST(warning.where == "dma");
  BOOST_TEST(warning.message == "length is zero");
  BOOST_TEST(warning.time_ps == 12'345'000u);
  BOOST_TEST(router->count("/markervp/axi_dma/length") == 1u);
  BOOST_TEST(router->count("/markervp/axi_dma/other") == 0u);
  BOOST_TEST(router->count(sc_core::SC_WARNING) == 1u);
  BOOST_TEST(router->count(sc_core::SC_ERROR) == 0u);
  BOOST_TEST(router->counts().size() == 1u);
}

BOOST_AUTO_TEST_CASE(reports_of_others_have_the_name_of_the_process) {
  dma.action = [] { SC_REPORT_WARNING("/foreign/id", "something"); };
  sc_core::sc_start();
  BOOST_TEST(out.str() == "warning: dma.run: something [/foreign/id] at 12.345 us\n");
}

BOOST_AUTO_TEST_CASE(info_is_printed_up_to_the_verbosity) {
  vp::info(dma, "/markervp/info", "important", sc_core::SC_LOW);
  vp::info(dma, "/markervp/info", "detail", sc_core::SC_MEDIUM);
  BOOST_TEST(out.str() == "info: dma: important [/markervp/info] at 0 ps\n");
  BOOST_TEST(router->count(sc_core::SC_INFO) == 1u);
  BOOST_TEST(router->warnings().empty());
}

BOOST_AUTO_TEST_CASE(an_error_throws) {
  BOOST_TEST(message_of([this] { vp::error(dma, "/markervp/error", "cannot go on"); }) ==
             "dma: cannot go on");
  BOOST_TEST(out.str() == "error: dma: cannot go on [/markervp/error] at 0 ps\n");
  BOOST_TEST(router->count(sc_core::SC_ERROR) == 1u);
}

BOOST_AUTO_TEST_CASE(a_fatal_report_throws_too) {
  BOOST_TEST(message_of([] { SC_REPORT_FATAL("/foreign/fatal", "over"); }) == "over");
  BOOST_TEST(router->count(sc_core::SC_FATAL) == 1u);
}

BOOST_AUTO_TEST_CASE(an_error_in_a_process_ends_the_run) {
  dma.action = [this] { vp::error(dma, "/markervp/error", "cannot go on"); };
  BOOST_TEST(message_of([] { sc_core::sc_start(); }) == "dma: cannot go on");
}

BOOST_AUTO_TEST_CASE(warnings_do_not_throw_unless_asked_to) {
  BOOST_TEST(message_of([this] { vp::warn(dma, "/markervp/warn", "careful"); }) ==
             "nothing thrown");
  router->set_fail_on_warning(true);
  BOOST_TEST(message_of([this] { vp::warn(dma, "/markervp/warn", "careful"); }) == "dma: careful");
  BOOST_TEST(router->warnings().size() == 2u);
  BOOST_TEST(message_of([this] { vp::info(dma, "/markervp/info", "fine", sc_core::SC_LOW); }) ==
             "nothing thrown");
}

BOOST_AUTO_TEST_CASE(repeats_are_counted_but_not_printed) {
  for (std::uint64_t i = 0; i < vp::ReportRouter::kept_limit + 5; ++i)
    vp::warn(dma, "/markervp/warn", "again");
  const std::string text = out.str();
  BOOST_TEST(std::count(text.begin(), text.end(), '\n') ==
             static_cast<int>(vp::ReportRouter::repeat_limit));
  BOOST_TEST(text.find("again [/markervp/warn] at 0 ps (further ones are only counted)\n") !=
             std::string::npos);
  BOOST_TEST(router->count("/markervp/warn") == vp::ReportRouter::kept_limit + 5);
  BOOST_TEST(router->warnings().size() == vp::ReportRouter::kept_limit);
}

BOOST_AUTO_TEST_CASE(the_time_can_come_from_elsewhere) {
  router->set_time_source([] { return std::uint64_t{7'000}; });
  vp::warn(dma, "/markervp/warn", "ahead");
  BOOST_TEST(router->warnings().front().time_ps == 7'000u);
}

BOOST_AUTO_TEST_CASE(routers_nest_and_restore_what_was) {
  {
    std::ostringstream inner_out;
    vp::ReportRouter inner(sc_core::SC_DEBUG);
    inner.redirect(inner_out);
    vp::info(dma, "/markervp/info", "detail", sc_core::SC_DEBUG);
    BOOST_TEST(inner_out.str() == "info: dma: detail [/markervp/info] at 0 ps\n");
  }
  vp::info(dma, "/markervp/info", "detail", sc_core::SC_DEBUG);
  vp::warn(dma, "/markervp/warn", "outer");
  BOOST_TEST(out.str() == "warning: dma: outer [/markervp/warn] at 0 ps\n");
  BOOST_TEST(router->count(sc_core::SC_INFO) == 0u);
}

BOOST_AUTO_TEST_CASE(the_old_handler_and_actions_return) {
  using sc_core::sc_report_handler;
  router.reset();
  BOOST_TEST((sc_report_handler::get_handler() == &sc_report_handler::default_handler));
  const auto actions = sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_THROW);
  BOOST_TEST(actions == sc_core::SC_THROW);
  const int verbosity = sc_report_handler::get_verbosity_level();
  BOOST_TEST(verbosity == sc_core::SC_MEDIUM);
}

BOOST_AUTO_TEST_CASE(without_a_router_an_error_throws_and_names_the_object) {
  router.reset();
  BOOST_TEST(message_of([this] { vp::error(dma, "/markervp/error", "cannot go on"); }) ==
             "dma: cannot go on");
}

BOOST_AUTO_TEST_CASE(an_error_never_returns) {
  router.reset();
  const auto actions =
      sc_core::sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_DO_NOTHING);
  BOOST_CHECK_THROW(vp::error(dma, "/markervp/error", "cannot go on"), std::runtime_error);
  sc_core::sc_report_handler::set_actions(sc_core::SC_ERROR, actions);
}

// What happens while the software waits is reported where it continues, in the order in which it
// happened, whatever a message looks like.
BOOST_AUTO_TEST_CASE(lines_wait_for_their_place) {
  bool waits = true;
  router->set_place_source([&]() -> std::optional<std::string> {
    if (waits) return std::nullopt;
    return "pc 0x1";
  });
  std::string told;
  router->on_warning([&](const vp::Warning& w) { told += w.message; });
  dma.action = [&] {
    vp::warn(dma, "/markervp/a", "first");
    vp::info(dma, "/markervp/b", "second", sc_core::SC_LOW);
    vp::warn(dma, "/markervp/c", "third, pc 0x2");
    vp::ReportRouter::software_goes_on();
    BOOST_TEST(out.str() == "");
    BOOST_TEST(told == "");
    BOOST_TEST(router->warnings().size() == 2u);
    sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
    waits = false;
    vp::ReportRouter::software_goes_on();
    BOOST_TEST(told == "firstthird, pc 0x2");
    vp::warn(dma, "/markervp/a", "fourth");
    waits = true;
    vp::warn(dma, "/markervp/a", "fifth");
  };
  sc_core::sc_start();
  router->finish();
  BOOST_TEST(out.str() ==
             "warning: dma: first [/markervp/a] at 12.345 us, pc 0x1\n"
             "info: dma: second [/markervp/b] at 12.345 us\n"
             "warning: dma: third, pc 0x2 [/markervp/c] at 12.345 us, pc 0x1\n"
             "warning: dma: fourth [/markervp/a] at 13.345 us, pc 0x1\n"
             "warning: dma: fifth [/markervp/a] at 13.345 us\n");
}

// An error waits for nothing but what happened before it.
BOOST_AUTO_TEST_CASE(an_error_comes_behind_what_waits) {
  router->set_place_source([]() -> std::optional<std::string> { return std::nullopt; });
  dma.action = [this] {
    vp::warn(dma, "/markervp/a", "first");
    vp::error(dma, "/markervp/b", "broken");
  };
  BOOST_CHECK_THROW(sc_core::sc_start(), sc_core::sc_report);
  BOOST_TEST(out.str() ==
             "warning: dma: first [/markervp/a] at 12.345 us\n"
             "error: dma: broken [/markervp/b] at 12.345 us\n");
}

BOOST_AUTO_TEST_SUITE_END()
