#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <page/page_file.h>
#include <page/report_page.h>

namespace page = platform::page;
using Json = nlohmann::json;

BOOST_AUTO_TEST_SUITE(page_file)

namespace {

constexpr const char* bare = "<html><!--DATA--><script>show()</script></html>";

}  // namespace

BOOST_AUTO_TEST_CASE(data_stand_where_the_page_wants_them) {
  const std::string text = page::page_with(bare, {{"result", "{\"a\":1}"}, {"extras", "[]"}});
  BOOST_TEST(text ==
             "<html><script type=\"application/json\" id=\"result\">{\"a\":1}</script>\n"
             "<script type=\"application/json\" id=\"extras\">[]</script>\n"
             "<script>show()</script></html>");
}

BOOST_AUTO_TEST_CASE(no_name_of_a_file_ends_the_script) {
  for (const char* name :
       {"</script><script>alert(1)</script>", "<!--<script>", "</SCRIPT >", "a<b", "]]>"}) {
    const std::string json = Json{{"input", name}}.dump();
    const std::string safe = page::script_safe(json);
    BOOST_TEST(safe.find('<') == std::string::npos, name);
    BOOST_TEST(Json::parse(safe) == Json::parse(json), name);
  }
}

BOOST_AUTO_TEST_CASE(text_without_angle_brackets_stays_as_it_is) {
  const std::string json = R"({"path":"a\\b","text":"\u00e4 & \" ' >"})";
  BOOST_TEST(page::script_safe(json) == json);
}

BOOST_AUTO_TEST_CASE(a_block_is_found_again) {
  const std::string json = R"({"input":"</script>","n":[1,2]})";
  const std::string text = page::page_with(bare, {{"result", json}, {"result-b", "2"}});
  BOOST_TEST(Json::parse(page::block_of(text, "result")) == Json::parse(json));
  BOOST_TEST(page::block_of(text, "result-b") == "2");
  BOOST_TEST(page::block_of(text, "extras") == "");
}

BOOST_AUTO_TEST_CASE(the_built_page_holds_the_placeholder_once_and_loads_nothing) {
  const std::string_view built = page::page_template();
  if (built.empty()) return;  // built without it
  const std::size_t at = built.find("<!--DATA-->");
  BOOST_REQUIRE(at != std::string_view::npos);
  BOOST_TEST((built.find("<!--DATA-->", at + 1) == std::string_view::npos));
  BOOST_TEST((built.find("<script src") == std::string_view::npos));
  BOOST_TEST((built.find("rel=\"stylesheet\"") == std::string_view::npos));
}

// The examples of RFC 4648, section 10.
BOOST_AUTO_TEST_CASE(base64_of_every_length) {
  const std::pair<const char*, const char*> examples[] = {{"", ""},
                                                          {"f", "Zg=="},
                                                          {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},
                                                          {"foob", "Zm9vYg=="},
                                                          {"fooba", "Zm9vYmE="},
                                                          {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) BOOST_TEST(page::base64(bytes) == text);
  BOOST_TEST(page::base64(std::string("\xff\xef\x00", 3)) == "/+8A");
}

BOOST_AUTO_TEST_SUITE_END()
