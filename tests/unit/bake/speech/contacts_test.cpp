// Lips and teeth of speech on meshes that a kiosk shows: the built-in face always, the two people
// where they have been baked.
#include "assets/bake/speech/contacts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "core/base/arena.h"
#include "core/emotion/profiles.h"

namespace caryatid::bake {
namespace {

// A pack's person, all of it loaded.
struct Loaded {
  std::vector<std::byte> file, memory;
  std::vector<Vec4> image;
  pack::Loader loader;
  agent::Person person;

  bool load(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
    const auto bytes = std::as_bytes(std::span(text));
    file.assign(bytes.begin(), bytes.end());
    const auto header = pack::read_header(file);
    if (!header.ok()) return false;
    image.resize(header.value.image_bytes / sizeof(Vec4) + 1);
    if (!loader.begin(header.value, std::as_writable_bytes(std::span(image))).ok() ||
        !loader.feed(std::span(file).subspan(sizeof(pack::PackHeader))).ok() || !loader.end().ok())
      return false;
    memory.resize(agent::Person::arena_bytes(loader.view()));
    Arena arena(memory);
    return person.start(loader.view(), arena).ok() && person.refine(loader).ok();
  }
};

// Contacts among vowels of every kind; by default at the pace of lively speech.
std::vector<TimedPhone> phones(double vowel_s = 0.09, double contact_s = 0.07) {
  constexpr const char* kContacts[] = {"p", "f", "m", "v", "b"};
  constexpr const char* kVowels[] = {"ɑː", "iː", "uː", "æ", "ɔː", "ə"};
  std::vector<TimedPhone> out;
  double t = 0.3;
  for (std::size_t i = 0; i < 30; ++i) {
    out.push_back({t, kVowels[i % std::size(kVowels)]});
    out.push_back({t + vowel_s, kContacts[i % std::size(kContacts)]});
    t += vowel_s + contact_s;
  }
  out.push_back({t, ""});
  return out;
}

ContactReport measure(Loaded& loaded, emotion::Emotion e) {
  emotion::Weights weights{};
  weights[emotion::index_of(e)] = 1.0f;
  const auto p = phones();
  return measure_contacts(p, p.back().start_s + 0.3, emotion::expression(weights), &loaded.person);
}

TEST(SpeechContacts, LipsOfTheBuiltInFaceMeetInEveryMood) {
  const auto loaded = std::make_unique<Loaded>();
  ASSERT_TRUE(loaded->load(CARYATID_SOURCE_DIR "/firmware-app/builtin_face.pack"));
  for (std::size_t e = 0; e < emotion::kEmotionCount; ++e) {
    const ContactReport r = measure(*loaded, static_cast<emotion::Emotion>(e));
    EXPECT_EQ(r.bilabials, 18u);
    EXPECT_EQ(r.shut, r.bilabials) << emotion::kEmotionNames[e] << " " << r.widest_gap_m;
  }
}

TEST(SpeechContacts, LipsAndTeethOfBothPeopleMeetInEveryMood) {
  for (const char* name : {"woman", "man"}) {
    const std::string path =
        std::string(CARYATID_SOURCE_DIR "/build/host-release/packs/") + name + ".pack";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path << "; cross/host.sh build";
    const auto loaded = std::make_unique<Loaded>();
    ASSERT_TRUE(loaded->load(path)) << path;
    for (std::size_t e = 0; e < emotion::kEmotionCount; ++e) {
      const ContactReport r = measure(*loaded, static_cast<emotion::Emotion>(e));
      EXPECT_EQ(r.shut, r.bilabials) << name << " " << emotion::kEmotionNames[e];
      EXPECT_EQ(r.touching, r.labiodentals)
          << name << " " << emotion::kEmotionNames[e] << " " << r.farthest_teeth_m;
    }
  }
}

// Negative control: in haste, without the certainty of contacts, the same measure sees them missed.
TEST(SpeechContacts, InHasteABlendAloneMissesThemAndTheMouthDoesNot) {
  const auto loaded = std::make_unique<Loaded>();
  const std::string woman = CARYATID_SOURCE_DIR "/build/host-release/packs/woman.pack";
  const bool teeth = std::filesystem::exists(woman);
  ASSERT_TRUE(loaded->load(teeth ? woman : CARYATID_SOURCE_DIR "/firmware-app/builtin_face.pack"));
  const auto p = phones(0.05, 0.02);
  const double end_s = p.back().start_s + 0.3;
  const ContactReport blend = measure_contacts(p, end_s, {}, &loaded->person, speech::Mouth(false));
  EXPECT_EQ(blend.bilabials, 18u);
  EXPECT_EQ(blend.labiodentals, 12u);
  EXPECT_LT(blend.shut, 9u);
  EXPECT_LT(blend.touching, blend.labiodentals);
  EXPECT_GT(blend.farthest_teeth_m, kTeethMet_m);
  const ContactReport held = measure_contacts(p, end_s, {}, &loaded->person);
  EXPECT_EQ(held.shut, held.bilabials);
  if (teeth) {
    EXPECT_EQ(held.touching, held.labiodentals);
    EXPECT_LT(held.farthest_teeth_m, 0.4f * blend.farthest_teeth_m);
  }
}

TEST(SpeechContacts, AMouthThatIsHeldOpenIsSeen) {
  const auto loaded = std::make_unique<Loaded>();
  ASSERT_TRUE(loaded->load(CARYATID_SOURCE_DIR "/firmware-app/builtin_face.pack"));
  const std::vector<TimedPhone> vowels{{0.3, "ɑː"}, {0.5, "ɑː"}};
  std::vector<TimedPhone> wrong = vowels;
  wrong.push_back({0.9, "p"});  // Beyond what is shown: no frame of it exists.
  EXPECT_EQ(measure_contacts(wrong, 0.6, {}, &loaded->person).shut, 0u);
}

}  // namespace
}  // namespace caryatid::bake
