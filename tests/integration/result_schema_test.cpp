// The schema of result.json, on results of the program; and that the check would notice.
#include "result_schema.h"

#include <boost/test/unit_test.hpp>

#include "executable.h"

using namespace integration;

namespace {

/// Of two scenes, one of them without the marker's truth.
const Json& good_result() {
  static const Json result = [] {
    Workplace place;
    place.run({"z1.0", "demo", "--quiet", "--no-pictures"});
    return place.result();
  }();
  return result;
}

/// The places of all values in `json`, inner ones first.
void list_values(const Json& json, const Json::json_pointer& here,
                 std::vector<Json::json_pointer>& list) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) list_values(value, here / key, list);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) list_values(json[i], here / i, list);
  }
  if (!here.empty()) list.push_back(here);
}

/// New keys may come and go, and lists of any length are fine there.
bool is_free(const Json::json_pointer& place) {
  const std::string text = place.to_string();
  return text.rfind("/provenance/command_line/", 0) == 0 || text == "/provenance/revision" ||
         text == "/provenance/output";
}

bool is_element(const Json& json, const Json::json_pointer& place) {
  return json.at(place.parent_pointer()).is_array();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(result_schema)

BOOST_AUTO_TEST_CASE(results_of_scenes_and_images_fit) {
  BOOST_TEST(schema_problems(good_result()) == std::vector<std::string>{},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_key_of_another_type_is_noticed) {
  std::vector<Json::json_pointer> places;
  list_values(good_result(), Json::json_pointer(), places);
  BOOST_TEST(places.size() > 100u);
  for (const Json::json_pointer& place : places) {
    if (is_free(place)) continue;
    Json changed = good_result();
    changed[place] = changed[place].is_boolean() ? Json("yes") : Json(true);
    BOOST_TEST(!schema_problems(changed).empty(), place.to_string()
                                                      << " of another type is not noticed");
  }
}

BOOST_AUTO_TEST_CASE(a_missing_key_is_noticed) {
  std::vector<Json::json_pointer> places;
  list_values(good_result(), Json::json_pointer(), places);
  for (const Json::json_pointer& place : places) {
    const bool parameter = place.parent_pointer() == Json::json_pointer("/configuration");
    if (is_free(place) || parameter || is_element(good_result(), place)) continue;
    Json changed = good_result();
    changed.at(place.parent_pointer()).erase(place.back());
    BOOST_TEST(!schema_problems(changed).empty(),
               "missing " << place.to_string() << " is not noticed");
  }
}

BOOST_AUTO_TEST_CASE(lists_of_a_wrong_length_are_noticed) {
  for (const char* list :
       {"/frames", "/frames/0/markers/0/corners_px", "/frames/0/markers/0/corners_px/0",
        "/frames/0/markers/0/pose/rotation", "/frames/0/markers/0/pose/rotation/2",
        "/frames/0/markers/0/pose/translation_m"}) {
    Json changed = good_result();
    Json& values = changed.at(Json::json_pointer(list));
    values.erase(values.size() - 1);
    BOOST_TEST(!schema_problems(changed).empty(), list << " without its last is not noticed");
  }
}

BOOST_AUTO_TEST_CASE(values_that_cannot_be_are_noticed) {
  const std::vector<std::pair<const char*, Json>> wrong{{"/schema", 2u},
                                                        {"/fidelity", "rough"},
                                                        {"/system", "none"},
                                                        {"/frames/0/markers/0/id", 250u},
                                                        {"/frames/0/markers/0/rotation", 4u},
                                                        {"/summary/frames", 7u},
                                                        {"/summary/detected", 9u},
                                                        {"/frames/0/counts/corners", -1},
                                                        {"/frames/0/threshold", 99.5}};
  for (const auto& [place, value] : wrong) {
    Json changed = good_result();
    changed[Json::json_pointer(place)] = value;
    BOOST_TEST(!schema_problems(changed).empty(), place << " = " << value << " is not noticed");
  }
}

BOOST_AUTO_TEST_SUITE_END()
