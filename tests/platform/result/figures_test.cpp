#include <result/figures.h>
#include <result/members.h>

#include <boost/test/unit_test.hpp>

#include <optional>
#include <string>
#include <vector>

#include "input_error.h"

namespace facts = platform::facts;
namespace result = platform::result;
using facts::Better;
using facts::Figure;
using result::Json;

namespace {

facts::Work work_with(std::vector<Figure> figures) {
  facts::Work work;
  work.unit = "echo";
  work.plural = "echoes";
  work.figures = std::move(figures);
  return work;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Where a figure is declared in this file.
std::string at_line(int line) {
  return "result/figures_test.cpp:" + std::to_string(line);
}

struct Engine {
  double watts = 0;
  std::optional<double> turns;
  std::vector<std::pair<std::string, double>> cylinders;
};

result::Members<Engine> engine_members() {
  return result::Members<Engine>()
      .figure({"w", "W", "what it draws", Better::less}, &Engine::watts, 3)
      .figure({"turns", "1/s", "how fast it turns"}, &Engine::turns, 1)
      .named(
          "cylinders", {{"*", "°C", "how hot one is"}},
          [](const Engine& engine, const auto& found) {
            for (const auto& [name, hot] : engine.cylinders) found(name, hot);
          },
          1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(figure_table)

BOOST_AUTO_TEST_CASE(two_figures_of_one_name_are_refused_with_both_places) {
  result::FigureTable table;
  const Figure first("power.peak_w", "W", "most power");
  const Figure second("power.peak_w", "mW", "the same");
  BOOST_TEST(first.place == at_line(__LINE__ - 2));
  BOOST_TEST(second.place == at_line(__LINE__ - 2));
  table.add(first);
  BOOST_TEST(input_error([&] { table.add(second); }) == "figure 'power.peak_w' (" + second.place +
                                                            ") is declared twice: first in " +
                                                            first.place);
  BOOST_TEST(table.list().size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_figure_without_unit_name_or_meaning_is_refused) {
  result::FigureTable table;
  const Figure figure("power.peak_w", "", "most power");
  BOOST_TEST(input_error([&] { table.add(figure); }) ==
             "figure 'power.peak_w' (" + figure.place +
                 ") has no unit: write \"1\" for a count or a ratio");
  BOOST_TEST(has(input_error([&] { table.add({"power.peak_w", "W", ""}); }), "what it means"));
  BOOST_TEST(has(input_error([&] { table.add({"", "W", "most power"}); }), "has no name"));
  BOOST_TEST(table.list().empty());
}

BOOST_AUTO_TEST_CASE(figures_of_one_part_of_a_result_are_beside_each_other) {
  result::FigureTable table;
  for (const char* path : {"power.a", "clocks.a", "power.b"}) table.add({path, "1", "a number"});
  BOOST_TEST(table.list()[0].path == "power.a");
  BOOST_TEST(table.list()[1].path == "power.b");
  BOOST_TEST(table.list()[2].path == "clocks.a");
}

BOOST_AUTO_TEST_CASE(a_design_cannot_declare_what_the_platform_has) {
  facts::Work work = work_with({});
  work.tallies = {{"frames", "counted again", ""}};
  const std::string said = input_error([&] { result::declare(work); });
  BOOST_TEST(has(said, "'summary.frames'"), said);
  BOOST_TEST(has(said, "declared in result/run_members.cpp:"), said);
}

BOOST_AUTO_TEST_CASE(a_design_declares_a_figure_once) {
  const Figure depth("depth", "m", "how deep");
  const auto refusal = [](const std::vector<Figure>& list) {
    return input_error([&] { result::declare(work_with(list)); });
  };
  BOOST_TEST(refusal({depth, depth}) == "figure 'frames.figures.depth' (" + depth.place +
                                            ") is declared twice: first in " + depth.place);
  BOOST_TEST(has(refusal({{"depth", "", "how deep"}}), "has no unit"));
  BOOST_TEST(has(refusal({{"", "m", "how deep"}}), "has no name"));
  BOOST_TEST(has(refusal({{"*", "m", "how deep"}}), "a * in its name"));
}

BOOST_AUTO_TEST_CASE(designs_may_share_a_name_in_one_unit_only) {
  result::declare(work_with({{"loudness", "dB", "how loud"}}));
  result::declare(work_with({{"loudness", "dB", "how loud the echo is"}}));
  const std::string said = input_error([] {
    result::declare(work_with({{"loudness", "Pa", "how loud"}}));
  });
  BOOST_TEST(has(said, "is in Pa, and another design's in dB"), said);
}

BOOST_AUTO_TEST_CASE(what_a_design_declares_is_shown_in_its_words) {
  facts::Work work =
      work_with({{"signal_noise", "dB", "how clear it is", Better::more},
                 {"delay", "s", "how late it is", Better::less, "Delay of the echo"}});
  work.tallies = {{"clear", "above 20 dB", "", true, Better::more}};
  result::declare(work);
  const auto shown = result::shown_metric("frames.figures.signal_noise.mean", "echo");
  BOOST_REQUIRE(shown);
  BOOST_TEST(shown->title == "Signal noise");
  BOOST_TEST(shown->unit == "dB");
  BOOST_TEST(shown->better == 1);
  BOOST_TEST(result::shown_metric("frames.figures.delay.max")->title ==
             "Delay of the echo, largest");
  BOOST_TEST(result::shown_metric("summary.clear")->title == "Echoes above 20 dB");
  BOOST_TEST(result::shown_metric("summary.fps.mean", "echo")->title == "Echo rate");
  BOOST_TEST(result::unit_of_metric("frames.figures.signal_noise.max") == "dB");
  const Json own = result::own_figures_json(work);
  BOOST_TEST(own.size() == 3u);
  result::declare(own);  // as a file gives it back
  result::declare(Json::array());
}

BOOST_AUTO_TEST_CASE(people_see_a_latency_in_milliseconds) {
  const auto shown = result::shown_metric("summary.latency_us.mean");
  BOOST_REQUIRE(shown);
  BOOST_TEST(shown->unit == "ms");
  BOOST_TEST(shown->factor == 1e-3);
  BOOST_TEST(shown->better == -1);
  BOOST_TEST(!result::shown_metric("power.ambient_c").has_value());
  BOOST_TEST(result::shown_metric("frames.time_us.own_stage.mean")->title == "Stage: own stage");
}

BOOST_AUTO_TEST_CASE(members_write_what_they_declare) {
  const result::Members<Engine> members = engine_members();
  BOOST_TEST(members.json({1.23456, std::nullopt, {}}).dump() == R"({"w":1.235})");
  BOOST_TEST(members.json({-0.0001, 7.26, {{"left", 90.04}}}).dump() ==
             R"({"w":0.0,"turns":7.3,"cylinders":{"left":90.0}})");
  std::vector<std::string> paths;
  for (const Figure& figure : members.figures()) paths.push_back(figure.path);
  BOOST_TEST(paths == (std::vector<std::string>{"w", "turns", "cylinders.*"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(parts_of_a_value_declare_their_figures_below_it) {
  struct Car {
    std::optional<Engine> engine;
    std::vector<Engine> spares;
  };
  const auto engine = [](const Car& car) { return result::if_known(car.engine); };
  const auto members = result::Members<Car>()
                           .object("engine", engine_members(), engine)
                           .list("spares", engine_members(), &Car::spares)
                           .object("old", engine_members(), engine, true);
  BOOST_TEST(members.json({std::nullopt, {}}).dump() == R"({"spares":[],"old":null})");
  BOOST_TEST(members.json({std::nullopt, {Engine{2, 1.0, {}}}}).dump() ==
             R"({"spares":[{"w":2.0,"turns":1.0}],"old":null})");
  BOOST_TEST(members.figures().size() == 9u);
  BOOST_TEST(members.figures()[0].path == "engine.w");
  BOOST_TEST(members.figures()[5].path == "spares.*.cylinders.*");
}

BOOST_AUTO_TEST_SUITE_END()
