#include "assets/bake/human/recipe.h"

#include <toml++/toml.h>
#include <algorithm>
#include <stdexcept>

namespace caryatid::bake {
namespace {

float number(const toml::table& table, const char* key, float otherwise) {
  return table[key].value<float>().value_or(otherwise);
}

Vec3 triple(const toml::table& table, const char* key, Vec3 otherwise) {
  const toml::array* values = table[key].as_array();
  if (!values) return otherwise;
  if (values->size() != 3) throw std::runtime_error(std::string(key) + ": wants three numbers");
  Vec3 out{0};
  for (std::size_t i = 0; i < 3; ++i)
    out[static_cast<int>(i)] = (*values)[i].value<float>().value_or(0.0f);
  return out;
}

std::string text(const toml::table& table, const char* key) {
  return table[key].value<std::string>().value_or("");
}

// A misspelt key must not silently mean its default.
void expect_keys(const toml::table& table, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw std::runtime_error("unknown key " + std::string(key.str()));
}

Macro read_macro(const toml::table& t) {
  expect_keys(t, {"female", "age_years", "muscle", "weight", "height", "proportions", "cup",
                  "firmness", "caucasian", "asian", "african"});
  Macro m;
  m.female = number(t, "female", m.female);
  m.age_years = number(t, "age_years", m.age_years);
  m.muscle = number(t, "muscle", m.muscle);
  m.weight = number(t, "weight", m.weight);
  m.height = number(t, "height", m.height);
  m.proportions = number(t, "proportions", m.proportions);
  m.cup = number(t, "cup", m.cup);
  m.firmness = number(t, "firmness", m.firmness);
  m.caucasian = number(t, "caucasian", m.caucasian);
  m.asian = number(t, "asian", m.asian);
  m.african = number(t, "african", m.african);
  return m;
}

SkinRecipe read_skin(const toml::table& t) {
  expect_keys(t, {"texture", "tint", "lips", "lips_strength", "stubble", "lash_line", "eye_shadow",
                  "blush", "hairline_m", "lines", "tights"});
  SkinRecipe s;
  s.texture = text(t, "texture");
  s.tint = triple(t, "tint", s.tint);
  s.lips = triple(t, "lips", s.lips);
  s.lips_strength = number(t, "lips_strength", s.lips_strength);
  s.stubble = number(t, "stubble", s.stubble);
  s.lash_line = number(t, "lash_line", s.lash_line);
  s.eye_shadow = number(t, "eye_shadow", s.eye_shadow);
  s.blush = number(t, "blush", s.blush);
  s.tights = triple(t, "tights", s.tights);
  s.lines = number(t, "lines", s.lines);
  s.hairline_m = number(t, "hairline_m", s.hairline_m);
  return s;
}

PartRecipe read_part(const toml::table& t) {
  expect_keys(t, {"proxy", "texture", "tint", "saturation", "contrast", "softness", "gloss",
                  "shininess", "grow_m", "drop_above_m", "least_quads", "upper_only"});
  PartRecipe p;
  p.proxy = text(t, "proxy");
  p.texture = text(t, "texture");
  p.tint = triple(t, "tint", p.tint);
  p.saturation = number(t, "saturation", p.saturation);
  p.contrast = number(t, "contrast", p.contrast);
  p.softness = number(t, "softness", p.softness);
  p.gloss = number(t, "gloss", p.gloss);
  p.shininess = number(t, "shininess", p.shininess);
  p.grow_m = number(t, "grow_m", p.grow_m);
  p.drop_above_m = number(t, "drop_above_m", p.drop_above_m);
  p.least_quads = t["least_quads"].value_or(0);
  p.upper_only = t["upper_only"].value_or(false);
  return p;
}

Recipe read_table(const toml::table& t) {
  expect_keys(t, {"name", "macro", "targets", "skin", "eyes", "part", "rest_face"});
  Recipe out;
  out.name = text(t, "name");
  if (out.name.empty()) throw std::runtime_error("name: missing");
  if (const auto* macro = t["macro"].as_table()) out.macro = read_macro(*macro);
  if (const auto* targets = t["targets"].as_table())
    for (const auto& [key, value] : *targets)
      out.targets.push_back({std::string(key.str()), value.value<float>().value_or(0.0f)});
  if (const auto* skin = t["skin"].as_table()) out.skin = read_skin(*skin);
  if (const auto* eyes = t["eyes"].as_table()) {
    expect_keys(*eyes, {"iris"});
    out.eyes.iris = triple(*eyes, "iris", out.eyes.iris);
  }
  if (const auto* parts = t["part"].as_array())
    for (const auto& part : *parts)
      if (const auto* table = part.as_table()) out.parts.push_back(read_part(*table));
  if (const auto* faps = t["rest_face"].as_table())
    for (const auto& [key, value] : *faps) {
      const int fap = std::atoi(std::string(key.str()).c_str());
      if (fap < 3 || fap > 68)
        throw std::runtime_error("rest_face: no FAP " + std::string(key.str()));
      out.rest_face.emplace_back(fap, value.value<float>().value_or(0.0f));
    }
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
  try {
    return read_table(toml::parse_file(file.string()));
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(file.string() + ":" + std::to_string(error.source().begin.line) +
                             ": " + std::string(error.description()));
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
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
    throw std::runtime_error("targets: the base human has no " + target.name);
  return {{left, target.weight}, {right, target.weight}};
}

}  // namespace caryatid::bake
