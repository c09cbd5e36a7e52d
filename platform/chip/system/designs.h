#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include <chip/system/design.h>

namespace platform {

/// The designs that come with the program. The first is the usual one.
const std::vector<const DesignInfo*>& builtin_designs();

/// Adds designs to those that come with the program: one object of an application, before main().
class DesignRegistration {
 public:
  using Describe = const DesignInfo& (*)();
  DesignRegistration(std::initializer_list<Describe> designs);
};

/// One of these, or one from outside by the file of its shared object (load_design()). Throws
/// vp::InputError with the nearest match for a name that no design has.
const DesignInfo& design_named(const std::string& name);

/// The design to which a PS program belongs by its name; the usual one for all others. Throws
/// vp::InputError in a program without designs.
const DesignInfo& design_of_program(const std::string& program);

/// A design from outside: with a folder in its name, or the ending .so.
bool is_design_file(const std::string& name);

/// Where the programs of a design stand: the folder of its shared object; empty for one that is
/// built in.
std::string folder_of(const DesignInfo& design);

/// Loads it once; it stays loaded. Throws vp::InputError for a file that is no design, or one that
/// was built against another version.
const DesignInfo& load_design(const std::string& file);

/// The file of a PS program: `name` itself, or the installed program of that name. A word without
/// folder and extension names an installed program, unless a file is called so. Throws
/// vp::InputError if there is no program of that name.
std::string program_file(const std::string& name);

/// That of the first program that belongs to the design: `<name>.so` in the folder of a design from
/// outside, or installed. Throws vp::InputError if missing.
std::string usual_program(const DesignInfo& design);
/// Whether it is there; a program that comes with the platform is taken to be.
bool has_usual_program(const DesignInfo& design);

/// Whether program_file() takes the name for a file.
bool is_own_program(const std::string& name);

}  // namespace platform
