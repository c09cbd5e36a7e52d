#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

#include <result/page/report_page.h>
#include <vp/error.h>

#include <result/result_json.h>
#include "../report_kit.h"
#include "temporary_files.h"

namespace page = platform::page;
namespace facts = platform::facts;
namespace result = platform::result;
using Json = nlohmann::json;

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder with the result of a run.
struct Folder : kit::TemporaryFolder {
  explicit Folder(const std::string& input = "z1.0", std::uint32_t frames = 1) {
    platform::host::OutputFolder output(path());
    result::ResultWriter writer(output);
    for (std::uint32_t i = 0; i < frames; ++i) {
      facts::UnitReport frame = report_test::found_frame("z1.0", i);
      frame.input = input;
      writer.add(frame);
    }
    writer.finish(report_test::run_facts(), report_test::provenance(), {});
  }
  std::string page() const { return read(*this / "report.html"); }
  Json block(const char* id) const { return Json::parse(page::block_of(page(), id)); }
};

bool names(const vp::InputError& error, const std::string& text) {
  return std::string(error.what()).find(text) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(report_page)

BOOST_AUTO_TEST_CASE(a_run_has_its_result_in_the_page) {
  const Folder folder;
  if (!page::write_report(folder.path(), R"({"frames":{}})")) return;  // built without it
  BOOST_TEST(folder.block("result") == Json::parse(read(folder / "result.json")));
  BOOST_TEST(folder.block("extras") == Json::parse(R"({"frames":{}})"));
}

BOOST_AUTO_TEST_CASE(a_page_made_again_keeps_its_images) {
  const Folder folder;
  if (!page::write_report(folder.path(), R"({"frames":{"0":{"png":"AAAA"}}})")) return;
  page::write_report(folder.path());
  BOOST_TEST(folder.block("extras")["frames"]["0"]["png"] == "AAAA");
}

BOOST_AUTO_TEST_CASE(an_input_called_like_markup_stays_text) {
  const std::string name = "</script><img src=x onerror=alert(1)>.png";
  const Folder folder(name);
  if (!page::write_report(folder.path())) return;
  BOOST_TEST(folder.block("result")["frames"][0]["input"] == name);
  BOOST_TEST(folder.page().find("<img src=x") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_long_run_shows_its_first_frames) {
  const Folder folder("z1.0", 7000);
  if (!page::write_report(folder.path())) return;
  BOOST_TEST(folder.block("result")["frames"].size() == 2000);
  BOOST_TEST(folder.block("result")["summary"]["frames"] == 7000);
}

BOOST_AUTO_TEST_CASE(two_runs_are_compared) {
  const Folder first;
  const Folder second("roll30");
  const kit::TemporaryFolder folder;
  if (!page::write_comparison(first.path(), second.path(), folder / "both.html")) return;
  const std::string text = read(folder / "both.html");
  BOOST_TEST(Json::parse(page::block_of(text, "result"))["frames"][0]["input"] == "z1.0");
  BOOST_TEST(Json::parse(page::block_of(text, "result-b"))["frames"][0]["input"] == "roll30");
  const Json comparison = Json::parse(page::block_of(text, "comparison"));
  BOOST_TEST(comparison["folders"] == Json::array({first.path(), second.path()}));
  const Json& rows = comparison["figures"];
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [](const Json& each) { return each["title"] == "Frame rate"; });
  BOOST_REQUIRE((row != rows.end()));
  BOOST_TEST((*row)["unit"] == "frames/s");
  BOOST_TEST((*row)["better"] == 1);
  BOOST_TEST((*row)["a"] == Json::parse(page::block_of(text, "result"))["summary"]["fps"]["mean"]);
}

BOOST_AUTO_TEST_CASE(a_folder_without_results_is_refused) {
  const kit::TemporaryFolder folder;
  BOOST_CHECK_EXCEPTION(page::write_report(folder.path()), vp::InputError,
                        [](const auto& e) { return names(e, "result.json"); });
  BOOST_CHECK_EXCEPTION(
      page::write_comparison(folder.path(), folder.path(), folder / "both.html"), vp::InputError,
      [](const auto& e) { return names(e, "has no result.json: name a folder that"); });
  BOOST_CHECK_EXCEPTION(page::write_report("/no/such/folder"), vp::InputError,
                        [](const auto& e) { return names(e, "/no/such/folder"); });
}

BOOST_AUTO_TEST_CASE(a_damaged_result_is_refused) {
  const kit::TemporaryFolder folder;
  kit::write_file(folder / "result.json", "{\"schema\": 1, \"frames\": [");
  BOOST_CHECK_EXCEPTION(page::write_report(folder.path()), vp::InputError,
                        [](const auto& e) { return names(e, "result.json', line 1, column 2"); });
  for (const char* wrong : {"[]", R"({"unit": 7})", R"({"figures": [{"path": 1}]})"}) {
    kit::write_file(folder / "result.json", wrong);
    BOOST_CHECK_EXCEPTION(
        page::write_comparison(folder.path(), folder.path(), folder / "both.html"), vp::InputError,
        [](const auto& e) { return names(e, "was changed or is damaged: run it again"); });
  }
  BOOST_TEST(folder.entries() == std::vector<std::string>{"result.json"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(data_blocks)

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

// Data of others: a page shows a control character as such, and never does what it says.
BOOST_AUTO_TEST_CASE(control_characters_are_shown) {
  const std::string text = "a\n\x1b[31m\x7f\xe2\x80\xae\tb\xc2\x85 \xc3\xa4\\n\"";
  const std::string shown = "a\\n\\x1b[31m\\x7f\\u202e\\tb\\x85 \xc3\xa4\\n\"";
  for (const bool ascii : {false, true}) {
    const std::string json = Json{{text, {text, 1}}}.dump(1, ' ', ascii);
    BOOST_TEST(Json::parse(page::shown_json(json)) == (Json{{shown, {shown, 1}}}));
    const std::string page = page::page_with(bare, {{"result", json}});
    BOOST_TEST(Json::parse(page::block_of(page, "result")) == (Json{{shown, {shown, 1}}}));
  }
  BOOST_TEST(Json::parse(page::shown_json(R"("a\nb\u0007")", true)) == "a\nb\\x07");
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
