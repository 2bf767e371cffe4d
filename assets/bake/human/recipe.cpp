#include "assets/bake/human/recipe.h"

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "assets/bake/files/files.h"
#include "core/face/fap_fill.h"

namespace caryatid::bake {
namespace {

// A fault at a place of the file; read_recipe() puts the file's name before it.
struct Fault : std::runtime_error {
  Fault(const toml::node& node, const std::string& what)
      : std::runtime_error(what), line(node.source().begin.line) {}
  std::uint32_t line;
};

struct Range {
  double low, high;
};
constexpr Range kShare{0.0, 1.0};
constexpr Range kFactor{0.0, 10.0};

std::string words(const Range& range) {
  char text[64];
  std::snprintf(text, sizeof text, "%g to %g", range.low, range.high);
  return text;
}

double checked(const std::string& key, const toml::node& node, const Range& range) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= range.low && *value <= range.high))
    throw Fault(node, key + ": wants a number from " + words(range));
  return *value;
}

float number(const toml::table& table, const char* key, float otherwise, const Range& range) {
  const toml::node* node = table.get(key);
  return node == nullptr ? otherwise : static_cast<float>(checked(key, *node, range));
}

Vec3 triple(const toml::table& table, const char* key, Vec3 otherwise, const Range& range) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return otherwise;
  const toml::array* values = node->as_array();
  if (values == nullptr || values->size() != 3)
    throw Fault(*node, std::string(key) + ": wants three numbers from " + words(range));
  Vec3 out{0};
  for (std::size_t i = 0; i < 3; ++i)
    out[static_cast<int>(i)] = static_cast<float>(checked(key, *values->get(i), range));
  return out;
}

std::string text(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return "";
  const auto value = node->value<std::string>();
  if (!value) throw Fault(*node, std::string(key) + ": wants a text in quotes");
  return *value;
}

std::string needed_text(const toml::table& table, const char* key) {
  std::string value = text(table, key);
  if (value.empty())
    throw Fault(table, std::string(key) + ": missing; write " + key + " = \"...\"");
  return value;
}

const toml::table* sub_table(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  if (node != nullptr && !node->is_table())
    throw Fault(*node, std::string(key) + ": wants a table; write [" + key + "]");
  return node == nullptr ? nullptr : node->as_table();
}

// A misspelt key must not silently mean its default.
void expect_keys(const toml::table& table, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw Fault(value, "unknown key " + std::string(key.str()));
}

Macro read_macro(const toml::table& t) {
  expect_keys(t, {"female", "age_years", "muscle", "weight", "height", "proportions", "cup",
                  "firmness", "caucasian", "asian", "african"});
  Macro m;
  m.age_years = number(t, "age_years", m.age_years, {25.0, 90.0});
  const auto slider = [&t](const char* key, float* io) { *io = number(t, key, *io, kShare); };
  slider("female", &m.female);
  slider("muscle", &m.muscle);
  slider("weight", &m.weight);
  slider("height", &m.height);
  slider("proportions", &m.proportions);
  slider("cup", &m.cup);
  slider("firmness", &m.firmness);
  slider("caucasian", &m.caucasian);
  slider("asian", &m.asian);
  slider("african", &m.african);
  if (m.caucasian + m.asian + m.african <= 0.0f)
    throw Fault(t, "caucasian, asian, african: one of them must be above 0");
  return m;
}

SkinRecipe read_skin(const toml::table& t) {
  expect_keys(t, {"texture", "tint", "lips", "lips_strength", "stubble", "lash_line", "eye_shadow",
                  "blush", "hairline_m", "lines", "tights"});
  SkinRecipe s;
  s.texture = needed_text(t, "texture");
  s.tint = triple(t, "tint", s.tint, kFactor);
  s.lips = triple(t, "lips", s.lips, kShare);
  s.lips_strength = number(t, "lips_strength", s.lips_strength, kShare);
  s.stubble = number(t, "stubble", s.stubble, kShare);
  s.lash_line = number(t, "lash_line", s.lash_line, kShare);
  s.eye_shadow = number(t, "eye_shadow", s.eye_shadow, kShare);
  s.blush = number(t, "blush", s.blush, kShare);
  s.tights = triple(t, "tights", s.tights, {-1.0, 10.0});
  s.lines = number(t, "lines", s.lines, kFactor);
  s.hairline_m = number(t, "hairline_m", s.hairline_m, {0.0, 0.1});
  return s;
}

PartRecipe read_part(const toml::table& t) {
  expect_keys(t, {"proxy", "texture", "tint", "saturation", "contrast", "softness", "gloss",
                  "shininess", "grow_m", "drop_above_m", "least_quads", "upper_only"});
  PartRecipe p;
  p.line = t.source().begin.line;
  p.proxy = needed_text(t, "proxy");
  p.texture = text(t, "texture");
  p.tint = triple(t, "tint", p.tint, kFactor);
  p.saturation = number(t, "saturation", p.saturation, kFactor);
  p.contrast = number(t, "contrast", p.contrast, kFactor);
  p.softness = number(t, "softness", p.softness, kShare);
  p.gloss = number(t, "gloss", p.gloss, kFactor);
  p.shininess = number(t, "shininess", p.shininess, {1.0, 1000.0});
  p.grow_m = number(t, "grow_m", p.grow_m, {-0.1, 0.1});
  p.drop_above_m = number(t, "drop_above_m", p.drop_above_m, {0.0, 3.0});
  p.least_quads = static_cast<int>(number(t, "least_quads", 0.0f, {0.0, 1e6}));
  if (const toml::node* node = t.get("upper_only")) {
    if (!node->is_boolean()) throw Fault(*node, "upper_only: wants true or false");
    p.upper_only = node->value_or(false);
  }
  return p;
}

// Values beyond what a stream can say would be cut by the mixer.
std::pair<int, float> read_rest_fap(const std::string& key, const toml::node& node) {
  int fap = 0;
  const char* end = key.data() + key.size();
  const auto [at, error] = std::from_chars(key.data(), end, fap);
  if (error != std::errc{} || at != end || fap < 3 || fap > face::kFapCount)
    throw Fault(node, "rest_face: no FAP " + key + "; 3 to 68 there are");
  face::FapFrame low, high;
  low.set(fap, -1e9f);
  high.set(fap, 1e9f);
  face::limit_to_coding_range(&low);
  face::limit_to_coding_range(&high);
  return {fap, static_cast<float>(checked("rest_face: " + key, node,
                                          {double{low.get(fap)}, double{high.get(fap)}}))};
}

Recipe read_table(const toml::table& t) {
  expect_keys(t, {"name", "macro", "targets", "skin", "eyes", "part", "rest_face"});
  Recipe out;
  out.name = needed_text(t, "name");
  if (const auto* macro = sub_table(t, "macro")) out.macro = read_macro(*macro);
  if (const auto* targets = sub_table(t, "targets"))
    for (const auto& [key, value] : *targets) {
      const std::string name(key.str());
      out.targets.push_back({name, static_cast<float>(checked(name, value, {-1.0, 1.0}))});
      out.target_lines.push_back(value.source().begin.line);
    }
  if (const auto* skin = sub_table(t, "skin")) out.skin = read_skin(*skin);
  if (const auto* eyes = sub_table(t, "eyes")) {
    expect_keys(*eyes, {"iris"});
    out.eyes.iris = triple(*eyes, "iris", out.eyes.iris, kShare);
  }
  if (const toml::node* parts = t.get("part")) {
    if (!parts->is_array_of_tables()) throw Fault(*parts, "part: wants tables; write [[part]]");
    for (const toml::node& part : *parts->as_array())
      out.parts.push_back(read_part(*part.as_table()));
  }
  if (const auto* faps = sub_table(t, "rest_face"))
    for (const auto& [key, value] : *faps)
      out.rest_face.push_back(read_rest_fap(std::string(key.str()), value));
  return out;
}

// Names of the stops of a slider with the share that each gets.
struct Share {
  const char* name;
  float weight;
};
using Shares = std::vector<Share>;

Shares three_stops(float value, const char* low, const char* middle, const char* high) {
  return {{low, std::max(0.0f, 1.0f - 2.0f * value)},
          {middle, 1.0f - std::abs(2.0f * value - 1.0f)},
          {high, std::max(0.0f, 2.0f * value - 1.0f)}};
}

}  // namespace

Recipe read_recipe(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  try {
    return read_table(toml::parse(content, file.string()));
  } catch (const Fault& fault) {
    throw std::runtime_error(file.string() + ":" + std::to_string(fault.line) + ": " +
                             fault.what());
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(file.string() + ":" + std::to_string(error.source().begin.line) +
                             ": " + std::string(error.description()));
  }
}

void check_names(const Recipe& recipe, const BaseHuman& base, const std::filesystem::path& file) {
  if (recipe.skin.texture.empty())
    throw std::runtime_error(file.string() + ": [skin] texture: missing; write texture = \"...\"");
  for (const PartRecipe& part : recipe.parts)
    if (!std::filesystem::is_directory(base.folder() / "public/data/proxies" / part.proxy))
      throw std::runtime_error(file.string() + ":" + std::to_string(part.line) +
                               ": proxy: the base human has no " + part.proxy +
                               "; name one of its own");
  for (std::size_t i = 0; i < recipe.targets.size(); ++i) try {
      (void)expand_target(recipe.targets[i], base);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(recipe.target_lines[i]) + ": " +
                               error.what());
    }
}

std::vector<TargetWeight> macro_targets(const Macro& macro, const BaseHuman& base) {
  const Shares gender = {{"female", macro.female}, {"male", 1.0f - macro.female}};
  const float old = std::clamp((macro.age_years - 25.0f) / 65.0f, 0.0f, 1.0f);
  const Shares age = {{"young", 1.0f - old}, {"old", old}};
  const Shares muscle = three_stops(macro.muscle, "minmuscle", "averagemuscle", "maxmuscle");
  const Shares weight = three_stops(macro.weight, "minweight", "averageweight", "maxweight");
  const float sum = macro.caucasian + macro.asian + macro.african;
  const Shares people = {{"caucasian", macro.caucasian / sum},
                         {"asian", macro.asian / sum},
                         {"african", macro.african / sum}};
  const Shares height = {{"minheight", std::max(0.0f, 1.0f - 2.0f * macro.height)},
                         {"maxheight", std::max(0.0f, 2.0f * macro.height - 1.0f)}};
  const Shares proportions = {
      {"uncommonproportions", std::max(0.0f, 1.0f - 2.0f * macro.proportions)},
      {"idealproportions", std::max(0.0f, 2.0f * macro.proportions - 1.0f)}};
  const Shares cup = three_stops(macro.cup, "mincup", "averagecup", "maxcup");
  const Shares firmness =
      three_stops(macro.firmness, "minfirmness", "averagefirmness", "maxfirmness");

  std::vector<TargetWeight> out;
  const auto add = [&](std::string name, float w) {
    if (w > 0 && base.has_target(name)) out.push_back({std::move(name), w});
  };
  for (const Share& g : gender)
    for (const Share& a : age) {
      const std::string person = std::string(g.name) + "-" + a.name;
      const float w = g.weight * a.weight;
      for (const Share& p : people) add("macrodetails/" + (p.name + ("-" + person)), w * p.weight);
      for (const Share& m : muscle)
        for (const Share& k : weight) {
          const std::string build = person + "-" + m.name + "-" + k.name;
          const float wb = w * m.weight * k.weight;
          add("macrodetails/universal-" + build, wb);
          for (const Share& h : height)
            add("macrodetails/height/" + build + "-" + h.name, wb * h.weight);
          for (const Share& p : proportions)
            add("macrodetails/proportions/" + build + "-" + p.name, wb * p.weight);
          for (const Share& c : cup)
            for (const Share& f : firmness)
              add("breast/" + build + "-" + c.name + "-" + f.name, wb * c.weight * f.weight);
        }
    }
  return out;
}

std::vector<TargetWeight> expand_target(const TargetWeight& target, const BaseHuman& base) {
  if (base.has_target(target.name)) return {target};
  const std::size_t slash = target.name.rfind('/');
  const std::string folder = target.name.substr(0, slash + 1);
  const std::string leaf = target.name.substr(slash + 1);
  const std::string left = folder + "l-" + leaf, right = folder + "r-" + leaf;
  if (!base.has_target(left) || !base.has_target(right))
    throw std::runtime_error("targets: the base human has no " + target.name +
                             "; name one of its own");
  return {{left, target.weight}, {right, target.weight}};
}

}  // namespace caryatid::bake
