// The real voice program: eight languages, stress, marks, SSML, cancelling, memory. Skipped where
// it was not built or espeak-ng has no data.
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "platform/clock/clock.h"
#include "platform/voice/voice.h"

namespace caryatid::platform {
namespace {

class RealVoice : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string path = CARYATID_REAL_VOICE;
    if (path.empty())
      GTEST_SKIP() << "needs caryatid-voice; install libespeak-ng-dev and build again";
    ErrorLine error;
    ASSERT_TRUE(open_espeak_process(path.c_str(), voice_, error).ok()) << error.c_str();
    std::size_t count = 0;
    for (int i = 0; i < 150 && !voice_->ready(); ++i) {
      (void)voice_->pump(monotonic_us(), {}, &count, utterance_.get());
      usleep(20'000);
    }
    if (!voice_->ready()) GTEST_SKIP() << "needs espeak-ng's data; install espeak-ng-data";
  }

  Status hear(const SayJob& job) {
    utterance_->clear();
    samples_.clear();
    phones_.clear();
    Status status = voice_->say(job, monotonic_us());
    std::vector<std::int16_t> piece(4096);
    for (int i = 0; i < 3000 && status.ok() && !utterance_->finished(); ++i) {
      pollfd fd{voice_->descriptor(), POLLIN, 0};
      (void)poll(&fd, 1, 20);
      std::size_t count = 0;
      status = voice_->pump(monotonic_us(), piece, &count, utterance_.get());
      samples_.insert(samples_.end(), piece.begin(),
                      piece.begin() + static_cast<std::ptrdiff_t>(count));
    }
    for (const speech::Phone& p : utterance_->phones()) phones_.push_back(p.phoneme.begins);
    return status;
  }
  std::size_t count_of(speech::Contact contact) const {
    return static_cast<std::size_t>(std::count_if(
        phones_.begin(), phones_.end(), [&](const auto& s) { return s.contact == contact; }));
  }
  // The loudest sample around a moment.
  int loudness_at(std::int32_t time_ms) const {
    const auto from = static_cast<std::size_t>(time_ms) * voice_->rate_hz() / 1000;
    int most = 0;
    for (std::size_t i = from; i < std::min(from + 1100, samples_.size()); ++i)
      most = std::max(most, std::abs(int{samples_[i]}));
    return most;
  }

  // Median fundamental frequency, and the spread of its middle four fifths, of what was heard: by
  // the first high peak of the autocorrelation in windows of 40 ms.
  struct Melody {
    double median_hz = 0.0, spread_hz = 0.0;
  };
  Melody melody() const {
    const auto rate = static_cast<int>(voice_->rate_hz());
    const std::size_t window = static_cast<std::size_t>(rate) / 25;
    std::vector<double> hz;
    for (std::size_t at = 0; at + 2 * window < samples_.size(); at += window / 2) {
      const auto likeness = [&](std::size_t lag) {
        double both = 0.0, a = 1e6, b = 1e6;
        for (std::size_t i = at; i < at + window; ++i) {
          both += double(samples_[i]) * samples_[i + lag];
          a += double(samples_[i]) * samples_[i];
          b += double(samples_[i + lag]) * samples_[i + lag];
        }
        return both / std::sqrt(a * b);
      };
      std::size_t best = 0;
      double most = 0.8;
      for (auto lag = static_cast<std::size_t>(rate / 260); lag < window * 4 / 5; ++lag)
        if (const double l = likeness(lag); l > most + 0.02) {
          most = l;
          best = lag;
        }
      if (best > 0) hz.push_back(double(rate) / static_cast<double>(best));
    }
    if (hz.size() < 10) return {};
    std::sort(hz.begin(), hz.end());
    return {hz[hz.size() / 2], hz[hz.size() * 9 / 10] - hz[hz.size() / 10]};
  }

  std::unique_ptr<Voice> voice_;
  std::unique_ptr<speech::Utterance> utterance_ = std::make_unique<speech::Utterance>();
  std::vector<std::int16_t> samples_;
  std::vector<speech::Sound> phones_;
};

TEST_F(RealVoice, EnglishHasItsContactsAndItsWords) {
  ASSERT_TRUE(hear({.text = "Welcome! Press five for maps."}).ok());
  EXPECT_EQ(count_of(speech::Contact::lips), 4u);       // m p m p
  EXPECT_EQ(count_of(speech::Contact::lip_teeth), 3u);  // f v f
  ASSERT_EQ(utterance_->words().size(), 5u);
  EXPECT_EQ(utterance_->words()[1].begin_byte, 9u);
  EXPECT_EQ(utterance_->words()[1].end_byte, 14u);
  EXPECT_EQ(utterance_->sentences_ms().size(), 2u);
  EXPECT_TRUE(utterance_->words()[0].stressed());
  EXPECT_FALSE(utterance_->words()[3].stressed());  // "for"
}

TEST_F(RealVoice, GreekHasItsContactsAndItsBytes) {
  const std::string_view text = "Καλώς ήρθατε! Πατήστε πέντε.";
  ASSERT_TRUE(hear({.text = text, .language = "el"}).ok());
  EXPECT_EQ(count_of(speech::Contact::lips), 2u);          // Π π
  EXPECT_EQ(count_of(speech::Contact::tongue_teeth), 1u);  // θ
  ASSERT_EQ(utterance_->words().size(), 4u);
  const speech::Word& second = utterance_->words()[1];
  EXPECT_EQ(text.substr(second.begin_byte, second.end_byte - second.begin_byte), "ήρθατε");
  EXPECT_TRUE(second.stressed());
}

TEST_F(RealVoice, SoundsAreWhereTheEventsSay) {
  // A vowel after a pause is loud; the pause is silent.
  ASSERT_TRUE(hear({.text = "Ah. Ah. Ah."}).ok());
  int vowels = 0;
  for (std::size_t i = 0; i < phones_.size(); ++i) {
    const std::int32_t at = utterance_->phones()[i].start_ms;
    if (phones_[i].vowel) {
      ++vowels;
      EXPECT_GT(loudness_at(at + 30), 2000) << at;
    }
    const bool pause = phones_[i].silent() && i + 1 < phones_.size() &&
                       utterance_->phones()[i + 1].start_ms > at + 200;
    if (pause) {
      EXPECT_LT(loudness_at(at + 120), 200) << at;
    }
  }
  EXPECT_EQ(vowels, 3);
  EXPECT_NEAR(static_cast<double>(samples_.size()) * 1000.0 / voice_->rate_hz(),
              utterance_->end_ms(), 2.0);
}

TEST_F(RealVoice, EightLanguagesSpeakAndMoveTheLips) {
  const std::pair<const char*, const char*> texts[] = {
      {"en", "My name is Maria, bonus for people."}, {"el", "Με λένε Μαρία, μπαμπά."},
      {"de", "Mein Name ist Pia, bitte."},           {"fr", "Je m'appelle Pierre, bonjour."},
      {"es", "Me llamo Pepe, buenos días."},         {"it", "Mi chiamo Beppe, prego."},
      {"ru", "Меня зовут Боб, пожалуйста."},         {"tr", "Benim adım Mert, buyurun."}};
  for (const auto& [language, text] : texts) {
    ASSERT_TRUE(hear({.text = text, .language = language}).ok()) << language;
    EXPECT_GE(count_of(speech::Contact::lips), 3u) << language;
    EXPECT_GT(samples_.size(), 20'000u) << language;
    const auto unknown = std::count_if(phones_.begin(), phones_.end(), [](const auto& s) {
      return s.first == 11 && s.second == 0 && s.hold < 0.25f && s.hold > 0.15f;
    });
    EXPECT_EQ(unknown, 0) << language << ": phonemes that the IPA chart here lacks";
  }
}

TEST_F(RealVoice, PaceAndMelodyAreAskedFor) {
  const std::string_view text = "Are you really going to the museum tomorrow morning?";
  ASSERT_TRUE(hear({.text = text}).ok());
  const std::size_t own = samples_.size();
  const Melody plain = melody();
  ASSERT_TRUE(hear({.text = text, .rate = 1.3f}).ok());
  EXPECT_LT(samples_.size(), own * 9 / 10);
  ASSERT_TRUE(hear({.text = text, .pitch = 1.4f}).ok());
  EXPECT_GT(melody().median_hz, 1.2 * plain.median_hz);
  ASSERT_TRUE(hear({.text = text, .range = 1.8f}).ok());
  EXPECT_GT(melody().spread_hz, 1.15 * plain.spread_hz);
}

TEST_F(RealVoice, RegionsFallBackToTheirLanguage) {
  EXPECT_TRUE(hear({.text = "Hallo", .language = "de-AT"}).ok());
  EXPECT_GT(samples_.size(), 5000u);
}

TEST_F(RealVoice, AnUnknownLanguageIsRefused) {
  const Status status = hear({.text = "x", .language = "tlh"});
  EXPECT_EQ(status.code, Code::unsupported);
  EXPECT_EQ(status.detail, static_cast<std::uint16_t>(VoiceTrouble::no_language));
  EXPECT_TRUE(hear({.text = "but English works"}).ok());
}

TEST_F(RealVoice, MarksAndLanguagesOfSsml) {
  const std::string_view text =
      "<speak>Hello <mark name=\"wave\"/>dear <lang xml:lang=\"el\">καλημέρα</lang> friend</speak>";
  ASSERT_TRUE(hear({.text = text, .ssml = true}).ok());
  ASSERT_EQ(utterance_->marks().size(), 1u);
  EXPECT_STREQ(utterance_->marks()[0].name.c_str(), "wave");
  ASSERT_EQ(utterance_->words().size(), 4u);
  const speech::Word& greek = utterance_->words()[2];
  EXPECT_EQ(text.substr(greek.begin_byte, greek.end_byte - greek.begin_byte), "καλημέρα");
  // Spelled letter by letter, as a voice without Greek does, it would take three seconds.
  EXPECT_LT(utterance_->words()[3].start_ms - greek.start_ms, 1300);
}

TEST_F(RealVoice, ANewTextInterruptsALongOne) {
  std::string text;
  for (int i = 0; i < 250; ++i) text += "This sentence never ends, ";
  ASSERT_TRUE(voice_->say({.text = text}, monotonic_us()).ok());
  usleep(100'000);
  voice_->cancel();
  const std::int64_t start_us = monotonic_us();
  ASSERT_TRUE(hear({.text = "Short."}).ok());
  EXPECT_EQ(utterance_->words().size(), 1u);
  EXPECT_LT(samples_.size(), 40'000u);
  EXPECT_LT(monotonic_us() - start_us, 3'000'000);
}

TEST_F(RealVoice, FitsIntoTwelveMegabytes) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "needs a build without sanitizers; theirs is the memory here";
#endif
  std::string text;
  for (int i = 0; i < 60; ++i) text += "A long text with many words and 12345 numbers. ";
  for (const char* language : {"en", "el", "ru"})
    ASSERT_TRUE(hear({.text = text, .language = language}).ok());
  // Its process is our only child.
  std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
  int child = 0;
  if (!(children >> child)) GTEST_SKIP() << "needs a kernel that lists a process's children";
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  std::string line;
  long most_kb = 0;
  while (std::getline(status, line))
    if (line.starts_with("VmHWM:")) most_kb = std::stol(line.substr(6));
  EXPECT_GT(most_kb, 1000);
  EXPECT_LE(most_kb, 12 * 1024);
  RecordProperty("voice_most_kb", static_cast<int>(most_kb));
}

}  // namespace
}  // namespace caryatid::platform
