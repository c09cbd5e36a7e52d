#include <sys/wait.h>
#include <unistd.h>

#include <study/worker.h>

#include "sweep_kit.h"

using namespace platform::study;
namespace result = platform::result;

namespace {

PointMessage message(std::uint64_t item, const result::Metrics& metrics) {
  PointMessage result;
  result.item = item;
  result.wall_s = 0.5;
  result.failed = true;
  result.failure = {3, 9, "why"};
  result.complaints = {{"fits", "too big"}, {"timing", "missed"}};
  result.metrics = metrics;
  return result;
}

}  // namespace

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

BOOST_AUTO_TEST_CASE(messages_arrive_whole_however_they_are_cut) {
  const result::Metrics first{{"a", 1}, {"b", 2}};
  const result::Metrics second{{"a", 3}, {"b", 4}};
  MessageWriter writer;
  std::string bytes = writer.bytes(message(1, first));
  const std::size_t with_names = bytes.size();
  const std::string without = writer.bytes(message(2, second));
  BOOST_TEST(without.size() < with_names);
  bytes += without + writer.bytes(message(3, result::Metrics{{"c", 5}}));
  MessageReader reader;
  std::vector<PointMessage> read;
  for (const char byte : bytes) {
    reader.add(std::string_view(&byte, 1));
    while (const auto next = reader.next()) read.push_back(*next);
  }
  BOOST_REQUIRE(read.size() == 3u);
  BOOST_TEST(read[0].item == 1u);
  BOOST_TEST(read[0].failed);
  BOOST_TEST(read[0].failure.message == "why");
  BOOST_TEST(read[0].failure.signal == 9);
  BOOST_TEST(read[0].wall_s == 0.5);
  BOOST_TEST((read[0].complaints == message(0, {}).complaints));
  BOOST_TEST(*read[0].metrics.find("b") == 2);
  BOOST_TEST(*read[1].metrics.find("b") == 4);
  BOOST_TEST(read[1].metrics.shares_names(read[0].metrics));
  BOOST_TEST(*read[2].metrics.find("c") == 5);
  BOOST_TEST(!read[2].metrics.find("a"));
  // A reader in place of another shares what that one's messages had.
  MessageReader later(read[0].metrics);
  later.add(MessageWriter().bytes(message(4, second)));
  BOOST_TEST(later.next()->metrics.shares_names(read[0].metrics));
}

BOOST_AUTO_TEST_CASE(half_a_message_is_none) {
  const std::string bytes = MessageWriter().bytes(message(1, result::Metrics{{"a", 1}}));
  MessageReader reader;
  reader.add(std::string_view(bytes).substr(0, bytes.size() - 1));
  BOOST_TEST(!reader.next().has_value());
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
