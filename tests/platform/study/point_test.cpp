#include <host/digest.h>
#include <result/metrics.h>
#include <result/table.h>
#include <study/kept_result.h>
#include <study/manifest.h>
#include <study/report.h>
#include <study/store.h>
#include <vp/unit.h>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform::study;
namespace result = platform::result;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

Manifest one_point() {
  Manifest manifest;
  manifest.name = "one";
  manifest.program = {{"version", "1"}};
  manifest.families.push_back({"hybrid", {{"a", "1"}, {"b", "2"}}, {{"a", "1"}, {"b", "1"}}, {}});
  manifest.input_sets.push_back({{"demo"}, {{"name", "demo"}}});
  Point point;
  point.changes = {{"a", "5"}};
  point.swept = {{"a", "5"}};
  point.key = key_of(manifest.identity(point));
  manifest.points.push_back(point);
  return manifest;
}

KeptResult kept_of(const Manifest& manifest) {
  const Point& point = manifest.points[0];
  return {point.key,
          manifest.identity(point),
          manifest.setup(point),
          {},
          {{"provenance", {{"host", "h"}}}, {"summary", {{"frames", 1}}}}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(points)

BOOST_AUTO_TEST_CASE(the_hash_is_sha_256) {
  BOOST_TEST(platform::host::content_hash("abc") ==
             "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

BOOST_AUTO_TEST_CASE(what_decides_the_result_decides_the_key) {
  const Manifest manifest = one_point();
  Manifest other = manifest;
  other.program["version"] = "2";
  BOOST_TEST(key_of(other.identity(other.points[0])) != manifest.points[0].key);
  other = manifest;
  other.families[0].configuration["b"] = "3";
  BOOST_TEST(key_of(other.identity(other.points[0])) != manifest.points[0].key);
  other = manifest;
  other.name = other.text = "another";
  BOOST_TEST(key_of(other.identity(other.points[0])) == manifest.points[0].key);
}

BOOST_AUTO_TEST_CASE(an_identity_has_the_changed_configuration_sorted) {
  Manifest manifest = one_point();
  Point& point = manifest.points[0];
  point.changes = {{"a", "5"}, {"aa", "\"quoted\"\n\xc3\xa9"}, {"c", "7"}};
  const Json json = Json::parse(manifest.identity(point));
  BOOST_TEST(json.at("markervp").at("version") == "1");
  BOOST_TEST(json.at("configuration").dump() ==
             "{\"a\":\"5\",\"aa\":\"\\\"quoted\\\"\\n\xc3\xa9\",\"b\":\"2\",\"c\":\"7\"}");
  // It reads back from a point's file as the same text.
  BOOST_TEST(json.dump() == manifest.identity(point));
  manifest.families[0].configuration.clear();
  point.changes.clear();
  BOOST_TEST(Json::parse(manifest.identity(point)).at("configuration") == Json::object());
}

BOOST_AUTO_TEST_CASE(points_of_families_in_turn_have_the_identities_that_they_have_alone) {
  Manifest manifest = one_point();
  constexpr std::size_t families = 1200;  // more than Identities keeps in words
  for (std::size_t i = 1; i < families; ++i) {
    manifest.families.push_back(manifest.families[0]);
    manifest.families[i].configuration["b"] = std::to_string(i + 2);
  }
  Identities identities(manifest);
  Point point = manifest.points[0];
  for (int round = 0; round < 2; ++round) {
    for (point.family = 0; point.family < families; ++point.family)
      BOOST_REQUIRE(identities.of(point) == manifest.identity(point));
  }
}

BOOST_AUTO_TEST_CASE(only_what_is_no_default_is_set) {
  const Manifest manifest = one_point();
  const std::map<std::string, std::string> expected{{"a", "5"}, {"b", "2"}};
  BOOST_TEST((manifest.settings(manifest.points[0]) == expected));
}

BOOST_AUTO_TEST_CASE(a_manifest_reads_back) {
  const Manifest manifest = one_point();
  const kit::TemporaryFolder folder;
  const std::string file = folder / "manifest.json", other = folder / "again.json";
  write_manifest(file, manifest);
  const Manifest again = read_manifest(file);
  write_manifest(other, again);
  BOOST_TEST(kit::read_file(other) == kit::read_file(file));
  BOOST_TEST(again.points.size() == 1u);
  BOOST_TEST((again.points[0].swept == manifest.points[0].swept));
  BOOST_TEST(Json::parse(kit::read_file(file))["points"][0]["key"] == again.points[0].key);
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string text = kit::read_file(other);
    kit::write_file(file, text.replace(text.find(from), from.size(), to));
    return complaint([&] { read_manifest(file); });
  };
  BOOST_TEST(contains(damaged("\"family\":0", "\"family\":7"), "no manifest"));
  BOOST_TEST(contains(damaged("\"key\"", "\"kez\""), "no manifest"));
  BOOST_TEST(contains(damaged("\"points\": [", "\"points\": [7,"), "no manifest"));
  kit::write_file(file, "{}");
  BOOST_TEST(contains(complaint([&] { read_manifest(file); }), "no manifest"));
}

BOOST_AUTO_TEST_CASE(a_whole_result_reads_back_without_provenance) {
  const kit::TemporaryFolder folder;
  const Store store(folder.path());
  Manifest manifest = one_point();
  manifest.input = {{{"fit", "crop"}}, 7, 3};
  manifest.points[0].key = key_of(manifest.identity(manifest.points[0]));
  const KeptResult kept = kept_of(manifest);
  store.keep(kept);
  const KeptResult read = read_kept(store.kept_path(kept.key));
  BOOST_TEST(!read.outcome.failed);
  BOOST_TEST(!contains(kit::read_file(store.kept_path(read.key)), "host"));
  BOOST_TEST(*read.outcome.metrics.find("summary.frames") == 1);
  BOOST_TEST(read.identity == kept.identity);
  BOOST_TEST((read.setup.settings == kept.setup.settings));
  BOOST_TEST((read.setup.inputs == kept.setup.inputs));
  BOOST_TEST((read.setup.input.settings == kept.setup.input.settings));
  BOOST_TEST(read.setup.input.frames.value() == 7u);
  BOOST_TEST(read.setup.input.repeat == 3u);
}

BOOST_AUTO_TEST_CASE(damage_is_noticed) {
  const kit::TemporaryFolder folder;
  const Store store(folder.path());
  const Manifest manifest = one_point();
  store.keep(kept_of(manifest));
  const std::string path = store.kept_path(manifest.points[0].key);
  const std::string whole = kit::read_file(path);
  const auto said = [&](const std::string& text) {
    kit::write_file(path, text);
    return complaint([&] { read_kept(path); });
  };
  BOOST_TEST(contains(said(whole.substr(0, whole.size() / 2)), "damaged"));
  // What a power failure leaves counts as nothing; what was changed does not.
  const auto half = [&](const std::string& text) {
    kit::write_file(path, text);
    BOOST_CHECK_THROW(read_kept(path), HalfPoint);
  };
  half("");
  half(whole.substr(0, whole.size() - 2));
  half(std::string(whole.size(), '\0'));
  half(whole.substr(0, whole.size() / 2) + std::string(whole.size() - whole.size() / 2, '\0'));
  std::string changed = whole;
  changed.replace(changed.find("\"frames\":1"), 10, "\"frames\":2");
  BOOST_TEST(contains(said(changed), "was changed"));
  BOOST_TEST(contains(said("{}"), "no point of a sweep"));
  BOOST_TEST(contains(said("{\"markervp_point\": 99}"), "version 99"));
  BOOST_TEST(said(whole) == "");
  const std::string other = store.kept_path(std::string(key_digits, '0'));
  kit::write_file(other, whole);
  BOOST_TEST(contains(complaint([&] { read_kept(other); }), "under another name"));
}

BOOST_AUTO_TEST_CASE(one_sweep_a_folder) {
  const kit::TemporaryFolder folder;
  Store first(folder.path());
  first.lock();
  Store second(folder.path());
  BOOST_TEST(contains(complaint([&] { second.lock(); }), "another run or sweep writes into"));
}

BOOST_AUTO_TEST_CASE(metrics_are_named_by_their_path) {
  const result::Metrics metrics = result::metrics_of(Json::parse(R"({
    "timing": {"met": false, "modules": [
        {"name": "blob", "frequency_mhz": 60, "fmax_mhz": 55, "fmax_high_mhz": 55, "met": false},
        {"name": "corner", "frequency_mhz": 120, "fmax_mhz": 100, "fmax_high_mhz": 236, "met": false}, {"name": "bram", "met": true}]},
    "frames": [{"index": 0, "counts": {"corners": 2}, "markers": []},
               {"index": 1, "counts": {"corners": 4},
                "markers": [{"id": 1, "error": {"corner_px": 0.5}}]}]})"));
  BOOST_TEST(*metrics.find("timing.met") == 0);
  BOOST_TEST(*metrics.find("timing.modules.blob.fmax_mhz") == 55);
  BOOST_TEST(*metrics.find("timing.failed") == 1);
  BOOST_TEST(*metrics.find("timing.unknown") == 1);
  BOOST_TEST(*metrics.find("frames.counts.corners.mean") == 3);
  BOOST_TEST(*metrics.find("frames.counts.corners.max") == 4);
  BOOST_TEST(*metrics.find("frames.markers.mean") == 0.5);
  BOOST_TEST(*metrics.find("frames.error.corner_px.mean") == 0.5);
  BOOST_TEST(!metrics.find("frames.index.mean"));
}

BOOST_AUTO_TEST_CASE(a_module_with_several_rows_is_one_figure) {
  const result::Metrics metrics = result::metrics_of(Json::parse(R"({"power": {"modules": [
      {"name": "pl.blob_detection", "rail": "VCCINT", "kind": "clock", "w": 0.4, "mj": 3},
      {"name": "ps.ddr", "rail": "VCCO", "kind": "state", "w": 0.1, "mj": 1},
      {"name": "pl.blob_detection", "rail": "VCCBRAM", "kind": "clock", "w": 0.01, "mj": 0.5}]}})"));
  BOOST_TEST(*metrics.find("power.modules.pl.blob_detection.w") == 0.4 + 0.01);
  BOOST_TEST(*metrics.find("power.modules.pl.blob_detection.mj") == 3.5);
  BOOST_TEST(*metrics.find("power.modules.ps.ddr.w") == 0.1);
}

BOOST_AUTO_TEST_CASE(a_marker_counts_as_found_with_its_id_only) {
  const auto rate = [](const char* frames) {
    const result::Metrics metrics =
        result::metrics_of(Json::parse(std::string("{\"frames\": ") + frames + "}"));
    const double* found = metrics.find("summary.detection_rate");
    return found ? *found : -1;
  };
  BOOST_TEST(rate(R"([{"scene_marker": 7, "markers": [{"id": 3}, {"id": 7}]},
                      {"scene_marker": 7, "markers": [{"id": 3}]},
                      {"scene_marker": 7, "markers": []},
                      {"scene_marker": 7, "gave_up": "it stood"},
                      {"markers": [{"id": 5}]}])") == 0.25);
  BOOST_TEST(rate(R"([{"markers": [{"id": 5}]}])") == -1, "what a photograph has is not known");
}

BOOST_AUTO_TEST_CASE(times_of_a_frame_given_up_are_no_figures) {
  const result::Metrics metrics = result::metrics_of(Json::parse(R"({"frames": [
      {"counts": {"corners": 2}, "markers": [], "time_us": {"frame": 10, "pose": 4}},
      {"counts": {"corners": 4}, "markers": [], "gave_up": "binary image timed out",
       "time_us": {"frame": 90, "pose": 0}}]})"));
  BOOST_TEST(*metrics.find("frames.time_us.frame.mean") == 10);
  BOOST_TEST(*metrics.find("frames.time_us.frame.max") == 10);
  BOOST_TEST(*metrics.find("frames.time_us.pose.mean") == 4);
  BOOST_TEST(*metrics.find("frames.counts.corners.mean") == 3,
             "what was lost matters all the same");
}

BOOST_AUTO_TEST_CASE(figures_are_written_as_decimals) {
  for (const double value : {0.0, -0.0, 9.99e-6, 1e-5, 0.1, -2.25, 12345.678901234567,
                             999999999999999.0, 1e15, 1.5e15, 6.02e23, 1e-300})
    BOOST_TEST(result::csv_number(value) == vp::Decimal(value).text());
}

BOOST_AUTO_TEST_CASE(metrics_share_their_names) {
  const result::Metrics one{{"b", 1}, {"a", 2}, {"b", 3}};
  BOOST_TEST((one.names() == result::Metrics::Names{"a", "b"}));
  BOOST_TEST((one.values() == std::vector<double>{2, 4}));
  result::Metrics two{{"a", 5}, {"b", 6}};
  result::Metrics other{{"a", 5}, {"c", 6}};
  two.share_names(one);
  other.share_names(one);
  BOOST_TEST(two.shares_names(one));
  BOOST_TEST(!other.shares_names(one));
  BOOST_TEST(*two.find("b") == 6);
}

BOOST_AUTO_TEST_SUITE_END()
