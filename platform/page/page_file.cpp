#include <page/page_file.h>

#include <vp/file.h>

#ifdef MARKERVP_PAGE_TEMPLATE

extern "C" {
extern const char markervp_page_begin[] __attribute__((visibility("hidden")));
extern const char markervp_page_end[] __attribute__((visibility("hidden")));
}

#endif

namespace platform::page {

std::string_view page_template() {
#ifdef MARKERVP_PAGE_TEMPLATE
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

std::string page_with(std::string_view page, const std::vector<Block>& blocks) {
  const std::size_t at = page.find(placeholder);
  std::string text(page.substr(0, at));
  for (const Block& block : blocks) {
    text += block_start(block.id);
    text += script_safe(block.json);
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

}  // namespace platform::page
