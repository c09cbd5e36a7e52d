#include <page/page_file.h>

#ifdef MARKERVP_PAGE_TEMPLATE

extern "C" {
extern const char markervp_page_begin[] __attribute__((visibility("hidden")));
extern const char markervp_page_end[] __attribute__((visibility("hidden")));
}

namespace platform::page {

std::string_view page_template() {
  return {markervp_page_begin, static_cast<std::size_t>(markervp_page_end - markervp_page_begin)};
}

}  // namespace platform::page

#else

namespace platform::page {

std::string_view page_template() {
  return {};
}

}  // namespace platform::page

#endif
