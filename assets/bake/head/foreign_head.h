#pragma once
// A third-party head, an OBJ with a list of feature points and nothing else, as a character: the
// bake understands it (lids, lips, jaw, eyeballs), adds what it lacks, and derives its face
// animation tables by the same builders as for our own people.
#include <filesystem>

#include "assets/bake/face/head.h"
#include "assets/bake/face/working_ranges.h"
#include "assets/bake/head/placed_head.h"

namespace caryatid::bake::foreign {

struct ForeignHead {
  Character character;
  fat::Head head;                  // As the FAT builders saw it.
  std::vector<std::string> notes;  // What the bake found and made, a line each.
};

// `name` of the character and of the licence's source. Objects: head, eyes, teeth, tongue, and what
// else lies in the file; joints of neck and head only. Throws std::runtime_error, one line.
ForeignHead build_foreign_head(const Surface& surface, const PointList& points,
                               const std::string& name, const fat::WorkingRanges& ranges);

// What the head file says of its licence: lines of its comments that speak of licence or copyright;
// without one, that the file is silent.
std::vector<Licence> licences_of(std::string_view obj_text, const std::string& name);

}  // namespace caryatid::bake::foreign
