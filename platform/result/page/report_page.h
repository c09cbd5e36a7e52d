#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <facts/result.h>
#include <vp/configuration.h>

/// `report.html`: the page built from web/, with data put into it. The page itself knows how to
/// show them.
namespace platform::page {

/// A block of data: a script element of type `application/json` with this id.
struct Block {
  std::string id;          ///< letters and '-'
  std::string json;        ///< a whole JSON text
  bool has_lines = false;  ///< its texts are of several lines, which stay
};

/// The page without data; empty if the program was built without it.
std::string_view page_template();

/// `json` so that no text in it can end the script element around it: every '<' becomes "\u003c",
/// which JSON reads back as the same. A JSON text has '<' inside strings only.
std::string script_safe(std::string_view json);

/// `json` with the control characters in its texts, names included, as vp::visible() shows them:
/// no page shows anything else. `has_lines`: line feeds stay.
std::string shown_json(std::string_view json, bool has_lines = false);

/// The page with `blocks`, for a `page` that has the placeholder once.
std::string page_with(std::string_view page, const std::vector<Block>& blocks);

/// Writes the page, whole or not at all. False if the program was built without it. Throws
/// vp::InputError if the file cannot be written.
bool write_page(const std::string& path, const std::vector<Block>& blocks);

/// The JSON text of a block in a page that write_page() made; empty if it has none of that id.
std::string block_of(std::string_view page, std::string_view id);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// What the page of a run shows besides result.json: what the application says of units of work,
/// and what the parameters mean. Memory does not grow with the number of units.
class RunExtras {
 public:
  static constexpr std::size_t most_frames = 24;        ///< that the application speaks of
  static constexpr std::size_t most_bytes = 3'000'000;  ///< of it

  /// Keeps what the application says of a unit, a JSON text, as long as there is room.
  void add(std::uint32_t index, const std::string& view);
  /// A member of the block, for instance "timeline", as JSON text.
  void add_member(const std::string& name, const std::string& json);
  /// The block "extras".
  std::string json(const std::vector<vp::ParameterDescription>& parameters) const;

 private:
  std::string frames_;
  std::size_t count_ = 0;
  bool full_ = false;
  std::string members_;
};

inline constexpr const char* report_name = "report.html";
inline constexpr const char* detectors_name = "detectors.json";

/// Writes report.html into a folder that has result.json (a run), validation.json (a validation) or
/// detectors.json (a comparison of detectors), from these files; a sweep has its own
/// (sweep/report.h). Of a run, `extras` is the block that RunExtras made; empty: that of the page
/// that is there already, if there is one. False if the program was built without the page. Throws
/// vp::InputError if the folder has none of these, or a file is damaged.
bool write_report(const std::string& folder, const std::string& extras = "");

/// A page into `output` that compares the runs in two folders.
bool write_comparison(const std::string& first, const std::string& second,
                      const std::string& output);

}  // namespace platform::page
