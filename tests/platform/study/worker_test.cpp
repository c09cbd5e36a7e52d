#include <sys/wait.h>
#include <unistd.h>

#include <study/worker.h>

#include "sweep_kit.h"

using namespace platform::study;
namespace result = platform::result;

BOOST_AUTO_TEST_SUITE(workers)

BOOST_AUTO_TEST_CASE(each_item_is_taken_once_by_all_processes_together) {
  WorkQueue queue(3, 2);
  BOOST_TEST(!queue.held(0).has_value());
  const pid_t process = ::fork();
  if (process == 0) ::_exit(queue.take(1) == std::size_t{0} ? 0 : 1);
  int status = 0;
  ::waitpid(process, &status, 0);
  BOOST_TEST(status == 0);
  BOOST_TEST(queue.held(1).value() == 0u);
  BOOST_TEST(queue.take(0).value() == 1u);
  BOOST_TEST(queue.held(0).value() == 1u);
  BOOST_TEST(!queue.empty());
  BOOST_TEST(queue.take(0).value() == 2u);
  BOOST_TEST(queue.empty());
  BOOST_TEST(!queue.take(0).has_value());
  queue.release(0);
  BOOST_TEST(!queue.held(0).has_value());
  BOOST_TEST(!queue.stopped());
  queue.stop();
  BOOST_TEST(queue.stopped());
}

BOOST_AUTO_TEST_CASE(what_a_process_finishes_or_tells_the_others_see) {
  WorkQueue queue(3, 1);
  BOOST_TEST(queue.finished() == 0u);
  BOOST_TEST((queue.told() == WorkQueue::Stop::none));
  const pid_t process = ::fork();
  if (process == 0) {
    queue.finish(1);
    queue.tell(WorkQueue::Stop::no_host);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  BOOST_TEST(queue.finished() == 1u);
  BOOST_TEST(!queue.is_finished(0));
  BOOST_TEST(queue.is_finished(1));
  BOOST_TEST((queue.told() == WorkQueue::Stop::no_host));
}

BOOST_AUTO_TEST_CASE(results_of_one_shape_are_read_like_any) {
  const Json first = Json::parse(R"({"summary": {"b": 1, "a": 2}, "frames": [{"markers": []}]})");
  const Json second = Json::parse(R"({"summary": {"b": 3, "a": 4}, "frames": [{"markers": []}]})");
  const Json longer = Json::parse(R"({"summary": {"b": 3, "a": 4, "c": 5}})");
  const Json twins = Json::parse(R"({"modules": [{"name": "m", "w": 1}, {"name": "m", "w": 2}]})");
  const Json shorter = Json::parse(R"({"summary": {"b": 7}})");
  result::MetricsReader reader;
  const result::Metrics before = reader.read(first);
  for (const Json& result : {second, longer, shorter, twins, twins, first}) {
    const result::Metrics read = reader.read(result);
    const result::Metrics alone = result::metrics_of(result);
    BOOST_TEST((read.names() == alone.names()));
    BOOST_TEST((read.values() == alone.values()));
  }
  BOOST_TEST(*result::metrics_of(twins).find("modules.m.w") == 3, "those of one name are added up");
  BOOST_TEST(reader.read(second).shares_names(reader.read(first)));
}

BOOST_AUTO_TEST_CASE(a_common_figure_has_one_value_in_all_points_that_have_figures) {
  result::CommonFigures common;
  BOOST_TEST(!common.value("a").has_value(), "of no point");
  common.add({});
  common.add({{"a", 1}, {"b", 2}, {"c", 3}});
  common.add({{"a", 1}, {"b", 4}, {"c", 3}});
  common.add({});
  BOOST_TEST(common.value("a").value() == 1);
  BOOST_TEST(!common.value("b").has_value(), "it differs");
  BOOST_TEST(common.value("c").value() == 3);
  common.add({{"a", 1}, {"b", 2}, {"d", 5}});
  BOOST_TEST(common.value("a").value() == 1);
  for (const char* name : {"b", "c", "d", "e"})
    BOOST_TEST(!common.value(name).has_value(), "a point lacks it, or has another");
}

BOOST_AUTO_TEST_SUITE_END()
