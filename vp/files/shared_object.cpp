#include <vp/shared_object.h>

namespace vp {

namespace {

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// What stands behind `mark`, up to a blank or a comma.
std::string word_behind(std::string_view text, std::string_view mark) {
  const std::string_view rest = text.substr(text.find(mark) + mark.size());
  return std::string(rest.substr(0, rest.find_first_of(" ,")));
}

}  // namespace

// The GNU C library puts the file at fault before the colon: the object itself, or a library that
// it needs.
std::string load_problem(const std::string& path, std::string_view said) {
  const std::string file(said.substr(0, said.find(": ")));
  if (has(said, "undefined symbol: "))
    return "nothing defines '" + word_behind(said, "undefined symbol: ") +
           "', which it calls: link what does";
  if (has(said, "cannot open shared object file")) {
    if (file != path) return "it needs the library '" + file + "', which is not found";
    return std::string(said.substr(said.rfind(": ") + 2));
  }
  if (has(said, "version `") && has(said, "not found"))
    return "it was built against a newer '" + file + "': build it on this machine";
  for (const char* sign : {"invalid ELF header", "file too short", "ELF file", "wrong ELF class",
                           "only ET_DYN", "cannot dynamically load"}) {
    if (has(said, sign))
      return (file == path ? "it is" : "it needs '" + file + "', which is") +
             " no shared object for this machine: build it as one";
  }
  return std::string(said);
}

}  // namespace vp
