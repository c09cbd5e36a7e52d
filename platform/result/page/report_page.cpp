#include <result/page/report_page.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <host/document.h>
#include <result/figures.h>
#include <result/page/comparison_rows.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#ifdef MARKERVP_PAGE

extern "C" {
extern const char markervp_page_begin[] __attribute__((visibility("hidden")));
extern const char markervp_page_end[] __attribute__((visibility("hidden")));
}

#endif

namespace platform::page {

std::string_view page_template() {
#ifdef MARKERVP_PAGE
  return {markervp_page_begin, static_cast<std::size_t>(markervp_page_end - markervp_page_begin)};
#else
  return {};
#endif
}

namespace {

constexpr std::string_view placeholder = "<!--DATA-->";
constexpr std::string_view block_end = "</script>\n";

std::string block_start(std::string_view id) {
  return "<script type=\"application/json\" id=\"" + std::string(id) + "\">";
}

}  // namespace

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size() + json.size() / 64);
  std::size_t from = 0;
  for (std::size_t at = json.find('<'); at != std::string_view::npos; at = json.find('<', from)) {
    safe.append(json, from, at - from);
    safe += "\\u003c";
    from = at + 1;
  }
  return safe.append(json, from);
}

namespace {

/// A text of JSON that represents `text`, which has no quotes.
std::string with_double_backslashes(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\\' ? "\\\\" : std::string(1, c);
  return result;
}

/// The character of an escape of JSON, if it may be a control character.
std::string escaped_character(std::string_view escape) {
  switch (escape.size() > 1 ? escape[1] : '\0') {
    case 'b':
      return "\b";
    case 'f':
      return "\f";
    case 'n':
      return "\n";
    case 'r':
      return "\r";
    case 't':
      return "\t";
    case 'u':
      break;
    default:
      return "";
  }
  const unsigned code =
      static_cast<unsigned>(std::strtoul(std::string(escape.substr(2)).c_str(), nullptr, 16));
  const auto byte = [](unsigned value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 0x3f))};
  return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 0x3f)), byte(0x80 | (code & 0x3f))};
}

/// Bytes of the escape or character with which `json` begins.
std::size_t piece_size(std::string_view json) {
  const auto first = static_cast<unsigned char>(json[0]);
  const std::size_t size = first == '\\'   ? (json.substr(1, 1) == "u" ? 6 : 2)
                           : first >= 0xf0 ? 4
                           : first >= 0xe0 ? 3
                           : first >= 0xc0 ? 2
                                           : 1;
  return std::min(size, json.size());
}

/// White space between values, too. What follows the first byte of a character goes with that.
bool is_shown_as_it_is(char c) {
  constexpr unsigned char del = 0x7f, first_of_several = 0xc0;
  const auto byte = static_cast<unsigned char>(c);
  return c != '\\' && byte != del && byte < first_of_several;
}

}  // namespace

std::string shown_json(std::string_view json, bool has_lines) {
  std::string shown;
  shown.reserve(json.size());
  while (!json.empty()) {
    const auto* const odd = std::find_if_not(json.begin(), json.end(), is_shown_as_it_is);
    const auto plain = static_cast<std::size_t>(odd - json.begin());
    shown += json.substr(0, plain);
    json.remove_prefix(plain);
    if (json.empty()) break;
    const std::string_view piece = json.substr(0, piece_size(json));
    json.remove_prefix(piece.size());
    const bool escaped = piece[0] == '\\';
    const std::string character = escaped ? escaped_character(piece) : std::string(piece);
    const std::string seen = has_lines ? vp::visible_lines(character) : vp::visible(character);
    shown += seen == character ? std::string(piece) : with_double_backslashes(seen);
  }
  return shown;
}

std::string page_with(std::string_view page, const std::vector<Block>& blocks) {
  const std::size_t at = page.find(placeholder);
  std::string text;
  std::size_t size = page.size();
  for (const Block& block : blocks) size += block.json.size() + block.json.size() / 64;
  text.reserve(size);  // a page has megabytes: growing would copy them several times
  text += page.substr(0, at);
  for (const Block& block : blocks) {
    text += block_start(block.id);
    text += script_safe(shown_json(block.json, block.has_lines));
    text += block_end;
  }
  return text.append(page.substr(at + placeholder.size()));
}

bool write_page(const std::string& path, const std::vector<Block>& blocks) {
  if (page_template().empty()) return false;
  vp::write_file(path, page_with(page_template(), blocks));
  return true;
}

std::string block_of(std::string_view page, std::string_view id) {
  const std::string start = block_start(id);
  const std::size_t at = page.find(start);
  if (at == std::string_view::npos) return "";
  const std::size_t from = at + start.size();
  return std::string(page.substr(from, page.find(block_end, from) - from));
}

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[three >> shift & 63];
  }
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

namespace {

using result::Json;

std::string text_of(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void RunExtras::add(std::uint32_t index, const std::string& view) {
  if (full_ || count_ >= most_frames) return;
  if (count_ > 0 && frames_.size() + view.size() > most_bytes) {
    full_ = true;
    return;
  }
  frames_ += fmt::format("{}\"{}\":{}", count_++ == 0 ? "" : ",", index, view);
}

void RunExtras::add_member(const std::string& name, const std::string& json) {
  members_ += fmt::format(",{}:{}", text_of(name), json);
}

std::string RunExtras::json(const std::vector<vp::ParameterDescription>& parameters) const {
  std::string text = "{\"frames\":{" + frames_ + "},\"parameters\":[";
  bool first = true;
  for (const vp::ParameterDescription& p : parameters) {
    text +=
        fmt::format("{}[{},{},\"{}\",{}]", first ? "" : ",", text_of(p.path),
                    text_of(p.default_value), vp::to_string(p.source), text_of(p.documentation));
    first = false;
  }
  return text + "]" + members_ + "}";
}

namespace {

namespace fs = std::filesystem;
using result::Json;
constexpr auto replace = Json::error_handler_t::replace;

/// Of a longer run the page shows the first frames; the others stand in result.json.
constexpr std::size_t most_frames = 2000;
/// A result.json up to this size is put into the page as it is.
constexpr std::size_t small_file = 4'000'000;  // bytes

/// The JSON of a file with no more than the first `count` objects of its top-level list `list`, in
/// memory that does not grow with the others. Throws vp::InputError if it is not whole.
Json parse_first(const fs::path& path, const std::string& list, std::size_t count) {
  using Event = Json::parse_event_t;
  std::ifstream file(path, std::ios::binary);
  std::string key;
  std::size_t seen = 0;
  const auto refuse = [&](const std::string& problem) {
    throw vp::InputError("result '" + path.string() + "': " + problem + ": run it again");
  };
  const auto keep = [&](int depth, Event event, const Json& value) {
    if (depth > static_cast<int>(host::deepest_json)) refuse("its values are nested too deeply");
    if (depth == 1 && event == Event::key) key = value.get<std::string>();
    if (depth != 2 || key != list) return true;
    if (event == Event::object_start) return seen < count;
    if (event == Event::object_end) ++seen;
    return true;
  };
  try {
    return Json::parse(file, keep);
  } catch (const Json::parse_error& error) {
    refuse("from byte " + std::to_string(error.byte) + " on it is not JSON, or not whole");
  } catch (const Json::out_of_range&) {
    refuse("a number in it is too large");
  }
  return {};
}

/// Without the frames for which the page has no room.
std::string result_of(const fs::path& path) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) > small_file && !ignored) {
    return parse_first(path, "frames", most_frames).dump();
  }
  return vp::read_text(path, "result");
}

std::string extras_of_page(const fs::path& folder) {
  const fs::path page = folder / report_name;
  std::error_code ignored;
  return fs::exists(page, ignored)
             ? block_of(vp::read_text(page, "report", host::largest_result), "extras")
             : "";
}

[[noreturn]] void refuse_damaged(const std::string& what) {
  throw vp::InputError(what + " was changed or is damaged: run it again");
}

/// The tree of a result; the figures that its design declared are known from then on.
Json checked(const std::string& result, const fs::path& path) {
  const std::string what = "result '" + path.string() + "'";
  Json json = host::parse_json<Json>(result, what);
  try {
    result::declare(json.is_object() ? json.value("figures", Json::array()) : Json::array());
  } catch (const Json::exception&) {
    refuse_damaged(what);
  }
  return json;
}

/// The blocks of a run; their names end in `suffix`. A file that others wrote is checked.
void add_run(std::vector<Block>& blocks, const fs::path& folder, const std::string& suffix,
             std::string extras) {
  const fs::path path = folder / "result.json";
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    throw vp::InputError("'" + folder.string() +
                         "' has no result.json: name a folder that `markervp run` wrote");
  }
  std::string result = result_of(path);
  if (extras.empty()) {
    checked(result, path);
    extras = extras_of_page(folder);
  }
  blocks.push_back({"result" + suffix, std::move(result)});
  if (!extras.empty()) blocks.push_back({"extras" + suffix, std::move(extras)});
}

}  // namespace

bool write_report(const std::string& folder, const std::string& extras) {
  const fs::path root(folder);
  std::error_code ignored;
  std::vector<Block> blocks;
  if (fs::exists(root / "validation.json", ignored)) {
    const fs::path path = root / "validation.json";
    blocks.push_back(
        {"validation", host::read_json<Json>(path, "validation", host::largest_result).dump()});
    const fs::path frames = root / "frames.csv";
    if (fs::exists(frames, ignored)) {
      blocks.push_back(
          {"frames",
           Json(vp::read_text(frames, "table", host::largest_result)).dump(-1, ' ', false, replace),
           true});
    }
  } else if (fs::exists(root / detectors_name, ignored)) {
    blocks.push_back(
        {"detectors", host::read_json<Json>(root / detectors_name, "comparison").dump()});
  } else if (fs::exists(root / "result.json", ignored)) {
    add_run(blocks, root, "", extras);
    blocks.push_back({"figures", result::figures_json().dump()});
  } else {
    throw vp::InputError("'" + folder +
                         "' has neither result.json (a run), manifest.json (a sweep), "
                         "validation.json nor detectors.json: name a folder that markervp wrote");
  }
  return write_page((root / report_name).string(), blocks);
}

bool write_comparison(const std::string& first, const std::string& second,
                      const std::string& output) {
  std::vector<Block> blocks;
  add_run(blocks, first, "", "");
  add_run(blocks, second, "-b", "");
  const auto result = [](const std::string& folder) {
    const fs::path path = fs::path(folder) / "result.json";
    return checked(vp::read_text(path, "result", host::largest_result), path);
  };
  const auto rows = [&] {
    try {
      return comparison_rows(result(first), result(second));
    } catch (const Json::exception&) {
      refuse_damaged("a result of '" + first + "' and '" + second + "'");
    }
  };
  const Json comparison{{"folders", {first, second}}, {"figures", rows()}};
  blocks.push_back({"comparison", comparison.dump(-1, ' ', false, replace)});
  return write_page(output, blocks);
}

}  // namespace platform::page
