#include <chip/system/designs.h>
#include <cli/commands.h>
#include <fmt/format.h>
#include <vp/text.h>
#include <nlohmann/json.hpp>

#include <ostream>

namespace platform::cli {

int list_designs(const DesignsOptions& options, std::ostream& out) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  std::string text = fmt::format("{:<12} {:<20} {}\n", "design", "PS programs", "what");
  for (const DesignInfo* design : builtin_designs()) {
    list.push_back({{"name", design->name},
                    {"description", design->description},
                    {"programs", design->programs}});
    text += fmt::format("{:<12} {:<20} {}\n", design->name, vp::join(design->programs, ", "),
                        design->description);
  }
  if (options.json) {
    out << list.dump(2) << "\n";
  } else if (list.empty()) {
    out << "This program has no design of its own: give the file of one with --design.\n";
  } else {
    out << text << "\nThe first is the usual one; 'markervp run --design NAME' takes another.\n";
  }
  return done;
}

}  // namespace platform::cli
