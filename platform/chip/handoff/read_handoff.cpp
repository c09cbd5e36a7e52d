#include <chip/handoff/archive.h>
#include <chip/handoff/handoff.h>
#include <chip/handoff/xml.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace platform::handoff {

namespace {

std::string stem(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

/// The block designs that an archive names as such in its list of files; empty if it has no list.
std::vector<std::string> listed_designs(const Archive& archive, const std::string& file) {
  for (const char* list : {"sysdef.xml", "hwdef.xml"}) {
    if (!archive.has(list)) continue;
    const XmlDocument xml(archive.read(list), file + ":" + list);
    std::vector<std::string> names;
    for (const auto& entry : xml.root("Project").children("File")) {
      const bool is_design =
          attribute(entry, "Type") == "HW_HANDOFF" && attribute(entry, "BD_TYPE") == "DEFAULT_BD";
      const std::string name(attribute(entry, "Name"));
      if (is_design && archive.has(name)) names.push_back(name);
    }
    if (!names.empty()) return names;
  }
  return {};
}

/// Without a list: those that hold a processing system. Inner designs of IP have none.
std::vector<std::string> likely_designs(const Archive& archive) {
  std::vector<std::string> names;
  for (const std::string& name : archive.names()) {
    if (vp::ends_with(name, ".hwh") &&
        archive.read(name).find(":processing_system7:") != std::string::npos)
      names.push_back(name);
  }
  return names;
}

bool lists_pieces(const Archive& archive) {
  return std::any_of(archive.names().begin(), archive.names().end(), [&](const std::string& name) {
    return vp::ends_with(name, ".hwh") &&
           archive.read(name).find("MODTYPE=\"ps7_cortexa9\"") != std::string::npos;
  });
}

/// The drivers of own IP, which only archives hold.
std::vector<OwnDriver> drivers_in(const Archive& archive) {
  std::vector<PathAndText> files;
  for (const std::string& name : archive.names())
    if (is_of_driver(name)) files.emplace_back(name, archive.read(name));
  return own_drivers(files);
}

Handoff read_member(const Archive& archive, const std::string& file, const std::string& name) {
  Handoff handoff = read_hwh(archive.read(name), file + ":" + name);
  handoff.drivers = drivers_in(archive);
  return handoff;
}

Handoff read_archive(const Archive& archive, const std::string& file, const std::string& design) {
  std::vector<std::string> names = listed_designs(archive, file);
  if (names.empty()) names = likely_designs(archive);
  if (names.empty()) {
    const bool has_hwh =
        std::any_of(archive.names().begin(), archive.names().end(),
                    [](const std::string& name) { return vp::ends_with(name, ".hwh"); });
    throw vp::InputError("'" + file + "' " +
                         (!has_hwh ? "holds no hand-off (.hwh): export the hardware again"
                          : lists_pieces(archive)
                              ? in_pieces
                              : "holds no hand-off with a processing_system7: it is for another "
                                "family, or of an IP alone"));
  }
  std::vector<std::string> choices;
  choices.reserve(names.size());
  for (const std::string& name : names) choices.push_back(stem(name));
  // Two may have the same name, in different folders of the archive.
  if (std::set<std::string>(choices.begin(), choices.end()).size() < choices.size())
    choices = names;
  if (!design.empty()) {
    const auto found = std::find(choices.begin(), choices.end(), design);
    if (found == choices.end()) {
      throw vp::InputError("'" + file + "' has no design '" + design + "': there is " +
                           vp::one_of(choices));
    }
    const std::string& name = names[static_cast<std::size_t>(found - choices.begin())];
    return read_member(archive, file, name);
  }
  if (names.size() > 1) {
    throw vp::InputError("'" + file + "' holds " + std::to_string(names.size()) +
                         " designs: choose one with --block-design, " + vp::one_of(choices));
  }
  return read_member(archive, file, names.front());
}

}  // namespace

Handoff read_handoff(const std::string& file, const std::string& design) {
  std::string bytes = vp::read_text(file, "hand-off", Archive::largest);
  const std::string name = std::filesystem::path(file).filename().string();
  if (Archive::is_archive(bytes))
    return read_archive(Archive(std::move(bytes), file), name, design);
  const std::size_t begin = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (begin == std::string::npos || bytes[begin] != '<') {
    throw vp::InputError(
        "'" + file + "' is neither XML nor a zip: name the .hwh, .xsa or .hdf that Vivado wrote");
  }
  if (bytes.size() > Archive::largest_member)
    throw vp::InputError("'" + file + "' is larger than 64 MiB: no hand-off is");
  Handoff handoff = read_hwh(std::move(bytes), name);
  if (!design.empty() && design != handoff.name) {
    throw vp::InputError("'" + file + "' holds the design '" + handoff.name + "', not '" + design +
                         "'");
  }
  return handoff;
}

}  // namespace platform::handoff
