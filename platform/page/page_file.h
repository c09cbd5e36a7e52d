#pragma once

#include <string>
#include <string_view>
#include <vector>

/// `report.html`: the page built from web/, with data put into it. The page itself knows how to
/// show them.
namespace platform::page {

/// A block of data: a script element of type `application/json` with this id.
struct Block {
  std::string id;    ///< letters and '-'
  std::string json;  ///< a whole JSON text
};

/// The page without data; empty if the program was built without it.
std::string_view page_template();

/// `json` so that no text in it can end the script element around it: every '<' becomes "\u003c",
/// which JSON reads back as the same. A JSON text has '<' inside strings only.
std::string script_safe(std::string_view json);

/// The page with `blocks`, for a `page` that has the placeholder once.
std::string page_with(std::string_view page, const std::vector<Block>& blocks);

/// Writes the page, whole or not at all. False if the program was built without it. Throws
/// vp::InputError if the file cannot be written.
bool write_page(const std::string& path, const std::vector<Block>& blocks);

/// The JSON text of a block in a page that write_page() made; empty if it has none of that id.
std::string block_of(std::string_view page, std::string_view id);

}  // namespace platform::page
