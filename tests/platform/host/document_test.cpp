#include <host/document.h>

#include <boost/test/unit_test.hpp>

#include <vp/error.h>

#include "temporary_files.h"

namespace host = platform::host;
using Ordered = nlohmann::ordered_json;

namespace {

std::string complaint(const std::string& text) {
  try {
    host::parse_json(text, "result 'r'");
    return "nothing thrown";
  } catch (const vp::InputError& error) {
    return error.what();
  }
}

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(document)

BOOST_AUTO_TEST_CASE(json_is_read) {
  const auto json = host::parse_json<Ordered>(R"({"b":[1,{"a":"]}\"["}],"a":null})", "x");
  BOOST_TEST(json.dump() == R"({"b":[1,{"a":"]}\"["}],"a":null})");
}

BOOST_AUTO_TEST_CASE(what_is_no_json_is_told_with_its_place) {
  BOOST_TEST(
      complaint("{\"a\": 1,\n \"b\": oops}") ==
      "result 'r', line 2, column 7: this is not JSON, or not whole: make the file again, or "
      "correct it");
  BOOST_TEST(
      complaint("{\"a\": [1, 2") ==
      "result 'r', line 1, column 12: this is not JSON, or not whole: make the file again, or "
      "correct it");
  BOOST_TEST(complaint(" \n") == "result 'r': it is empty, which is not JSON");
  BOOST_TEST(complaint("[\"\xff\"]").rfind("result 'r', line 1, column 3: ", 0) == 0u);
  BOOST_TEST(complaint("[1e999]") == "result 'r': a number in it is too large");
}

/// Trees are copied and written recursively: 100 000 levels overran the stack.
BOOST_AUTO_TEST_CASE(depth_is_bounded) {
  const auto nested = [](std::size_t levels) {
    return repeated("[", levels) + repeated("]", levels);
  };
  BOOST_TEST(complaint(nested(host::deepest_json)) == "nothing thrown");
  BOOST_TEST(
      complaint("\n" + nested(host::deepest_json + 1)) ==
      "result 'r', line 2, column 65: more than 64 lists and objects inside each other: this "
      "is no file for markervp");
  BOOST_TEST(complaint(repeated("{\"a\":", 100'000)).find("more than 64") != std::string::npos);
  BOOST_TEST(complaint("[\"" + repeated("[", 1000) + "\\\"" + repeated("{", 1000) + "\"]") ==
                 "nothing thrown",
             "what is in a text is no list");
  BOOST_TEST(complaint("[" + repeated("[],", 1000) + "[]]") == "nothing thrown");
}

/// Memory ran out while the tree was taken down, which ended the program.
BOOST_AUTO_TEST_CASE(the_number_of_values_is_bounded) {
  const std::string text = complaint("[" + repeated("[],", 12'000'000) + "[]]");
  BOOST_TEST(text.find("more than 20 million values") != std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(a_file_is_named) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "a.json", "[1]");
  BOOST_TEST(host::read_json(folder / "a.json", "table").dump() == "[1]");
  kit::write_file(folder / "b.json", "[1");
  BOOST_CHECK_EXCEPTION(
      host::read_json(folder / "b.json", "table"), vp::InputError, [&](const auto& error) {
        return std::string(error.what())
                   .rfind("table '" + (folder / "b.json") + "', line 1, ", 0) == 0;
      });
}

BOOST_AUTO_TEST_CASE(a_document_is_made_once_for_each_text) {
  host::KeptDocuments<std::string> kept;
  int made = 0;
  const auto get = [&](const std::string& file, const std::string& text) {
    return *kept.get(file, text, [&](const std::string& of) {
      if (of == "bad") throw vp::InputError("it is bad");
      ++made;
      return "made of " + of;
    });
  };
  BOOST_TEST(get("a", "1") == "made of 1");
  BOOST_TEST(get("a", "1") == "made of 1");
  BOOST_TEST(made == 1);
  BOOST_TEST(get("b", "1") == "made of 1");
  BOOST_TEST(get("a", "2") == "made of 2", "a file that was changed is read again");
  BOOST_TEST(made == 3);
  BOOST_CHECK_THROW(get("a", "bad"), vp::InputError);
  BOOST_CHECK_THROW(get("a", "bad"), vp::InputError);
  for (int i = 0; i < 100; ++i) get(std::to_string(i), "x");
  BOOST_TEST(get("a", "1") == "made of 1");
}

BOOST_AUTO_TEST_SUITE_END()
