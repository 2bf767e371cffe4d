// caryatid-voice: espeak-ng as a program of its own, driven over a socket on its standard input
// (platform/voice/wire.h). The kiosk starts it; nobody else needs to.
//
// Licence: this source is Apache-2.0 like the rest of Caryatid, but the program is linked with
// libespeak-ng, so the binary as a whole is under the GPL version 3 or later. The kiosk itself only
// talks to it through the socket and links nothing of it.
#include <espeak-ng/speak_lib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "platform/voice/voice.h"
#include "platform/voice/wire.h"

namespace {

namespace wire = caryatid::platform::wire;
using caryatid::platform::VoiceTrouble;
using wire::Type;

constexpr int kSocket = STDIN_FILENO;
constexpr int kChunk_ms = 40;  // Of sound a callback: what the first word waits for.

void send_record(Type type, std::uint32_t utterance, std::string_view payload) {
  std::byte head[wire::kHeadBytes];
  wire::put_head(type, utterance, payload.size(), head);
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  bytes += payload;
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = send(kSocket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) std::_Exit(0);  // The kiosk is gone.
    sent += static_cast<std::size_t>(n);
  }
}

std::string number(std::uint32_t value) {
  std::byte bytes[4];
  wire::put_u32(value, bytes);
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

// Every byte of `text` in espeak-ng's dialect of SSML, and where each of its characters came from:
// <lang>, which espeak-ng does not know, becomes <voice>.
struct Script {
  std::string spoken;
  std::vector<std::uint32_t> byte_of;  // By character of `spoken`; one more for the end.

  Script(std::string_view text, bool ssml) {
    for (std::size_t i = 0; i < text.size();) {
      if (ssml && replace(text, "<lang", "<voice", &i)) continue;
      if (ssml && replace(text, "</lang", "</voice", &i)) continue;
      add(text[i], i);
      ++i;
    }
    byte_of.push_back(static_cast<std::uint32_t>(text.size()));
  }
  std::uint32_t byte_at(int character) const {
    const auto last = static_cast<int>(byte_of.size()) - 1;
    return byte_of[static_cast<std::size_t>(std::clamp(character, 0, last))];
  }

 private:
  void add(char c, std::size_t from) {
    if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u)
      byte_of.push_back(static_cast<std::uint32_t>(from));
    spoken += c;
  }
  bool replace(std::string_view text, std::string_view tag, std::string_view by, std::size_t* io) {
    if (text.compare(*io, tag.size(), tag) != 0) return false;
    const char next = *io + tag.size() < text.size() ? text[*io + tag.size()] : '\0';
    if (next != ' ' && next != '>') return false;
    for (const char c : by) add(c, *io);
    *io += tag.size();
    return true;
  }
};

// espeak-ng's events name phonemes without stress; its trace has the stress marks. The trace of a
// clause comes before the clause's events, so that each event finds its sound in it.
class StressTrace {
 public:
  StressTrace() : file_(open_memstream(&text_, &size_)) {
    if (file_ != nullptr) espeak_SetPhonemeTrace(espeakPHONEMES_IPA, file_);
  }
  void restart() {
    if (file_ == nullptr) return;
    std::fflush(file_);
    std::fseek(file_, 0, SEEK_SET);
    at_ = 0;
  }
  // True when a primary stress mark stands between the sound before and this one.
  bool stressed(std::string_view ipa) {
    if (file_ == nullptr) return false;
    std::fflush(file_);
    const std::string_view trace(text_, size_);
    // A sound that is not near was changed on the way; the next one will be found.
    constexpr std::size_t kNear = 28;
    const std::string_view near = trace.substr(std::min(at_, trace.size()), kNear + ipa.size());
    const std::size_t found = near.find(ipa);
    if (found == std::string_view::npos) return false;
    at_ += found + ipa.size();
    return near.substr(0, found).find("\u02C8") != std::string_view::npos;
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0, at_ = 0;
  std::FILE* file_;
};

class Program {
 public:
  bool start() {
    rate_hz_ = espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, kChunk_ms, nullptr,
                                 espeakINITIALIZE_PHONEME_EVENTS | espeakINITIALIZE_PHONEME_IPA |
                                     espeakINITIALIZE_DONT_EXIT);
    if (rate_hz_ <= 0) return false;
    espeak_SetSynthCallback(callback);
    self = this;
    trace_ = new StressTrace;
    send_record(Type::hello, 0, number(wire::kVersion) + number(std::uint32_t(rate_hz_)));
    return true;
  }

  // Serves until the kiosk hangs up.
  int run() {
    for (;;) {
      wire::Record record;
      const caryatid::Status status = reader_.next(&record);
      if (status.code == caryatid::Code::not_ready) {
        if (!read_more()) return 0;
        continue;
      }
      if (!status.ok()) {
        std::fputs("caryatid-voice: the kiosk sent what is no record; do not type here\n", stderr);
        return 1;
      }
      if (record.type == Type::say) say(record);
    }
  }

 private:
  static int callback(short* samples, int count, espeak_EVENT* events) {
    return self->deliver(samples, count, events);
  }

  bool read_more() {
    const auto room = reader_.room();
    const ssize_t n = read(kSocket, room.data(), room.size());
    if (n < 0 && errno == EINTR) return true;
    if (n <= 0) return false;
    reader_.took(static_cast<std::size_t>(n));
    return true;
  }

  bool set_language(const std::string& language) {
    if (language == language_) return true;
    std::string name = language;
    while (espeak_SetVoiceByName(name.c_str()) != EE_OK) {
      const std::size_t dash = name.rfind('-');  // de-AT, de-at, de
      if (dash == std::string::npos) return false;
      name.resize(dash);
    }
    language_ = language;
    return true;
  }

  void say(const wire::Record& record) {
    utterance_ = record.utterance;
    const bool ssml = record.payload[0] != std::byte{0};
    const auto language_bytes = std::to_integer<std::size_t>(record.payload[1]);
    const auto rest = record.text(wire::kSayBytes);
    if (language_bytes > rest.size()) return refuse(VoiceTrouble::refused_text);
    std::string language(rest.data(), language_bytes);
    for (char& c : language) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    if (!set_language(language)) return refuse(VoiceTrouble::no_language);
    const Script script({rest.data() + language_bytes, rest.size() - language_bytes}, ssml);
    script_ = &script;
    last_end_ = 0;
    const int rate = 175 * record.u16(2) / 100;  // 175 words a minute are espeak-ng's own pace.
    espeak_SetParameter(espeakRATE, std::clamp(rate, 80, 450), 0);
    // 50 is the voice's own, an octave lies 50 above.
    const double octaves = std::log2(std::max(record.u16(4), std::uint16_t{1}) / 100.0);
    espeak_SetParameter(espeakPITCH, std::clamp(static_cast<int>(50.5 + 50.0 * octaves), 0, 100),
                        0);
    espeak_SetParameter(espeakRANGE, std::clamp(50 * record.u16(6) / 100, 0, 100), 0);
    trace_->restart();
    samples_ = 0;
    cancelled_ = false;
    const unsigned flags = espeakCHARS_UTF8 | espeakENDPAUSE | (ssml ? espeakSSML : 0u);
    if (espeak_Synth(script.spoken.c_str(), script.spoken.size() + 1, 0, POS_CHARACTER, 0, flags,
                     nullptr, nullptr) != EE_OK)
      return refuse(VoiceTrouble::refused_text);
    if (!cancelled_)
      send_record(Type::end, utterance_,
                  number(std::uint32_t(samples_ * 1000 / static_cast<std::uint64_t>(rate_hz_))));
  }

  void refuse(VoiceTrouble why) {
    send_record(Type::refused, utterance_, std::string(1, static_cast<char>(why)));
  }

  // 1 ends the synthesis.
  int deliver(const short* samples, int count, const espeak_EVENT* events) {
    pollfd input{kSocket, POLLIN, 0};
    if (poll(&input, 1, 0) > 0) {  // Whatever the kiosk wants now, it is not the rest of this.
      cancelled_ = true;
      return 1;
    }
    for (; events != nullptr && events->type != espeakEVENT_LIST_TERMINATED; ++events)
      tell(*events);
    for (int done = 0; samples != nullptr && done < count;) {
      const int piece = std::min(count - done, int(wire::kMostPcmBytes / sizeof(short)));
      // Little-endian, as every machine that Caryatid runs on.
      send_record(Type::pcm, utterance_,
                  {reinterpret_cast<const char*>(samples + done),
                   static_cast<std::size_t>(piece) * sizeof(short)});
      done += piece;
      samples_ += static_cast<std::uint64_t>(piece);
    }
    return 0;
  }

  void tell(const espeak_EVENT& e) {
    const std::string time = number(static_cast<std::uint32_t>(std::max(e.audio_position, 0)));
    switch (e.type) {
      case espeakEVENT_PHONEME: {
        std::string ipa(e.id.string, strnlen(e.id.string, sizeof e.id.string));
        if (!ipa.empty() && trace_->stressed(ipa)) ipa.insert(0, "\u02C8");
        return send_record(Type::phone, utterance_, time + ipa);
      }
      case espeakEVENT_WORD: {
        const std::uint32_t begin = script_->byte_at(e.text_position - 1);
        const std::uint32_t end = script_->byte_at(e.text_position - 1 + e.length);
        if (begin < last_end_ || end <= begin) return;  // One number is told digit by digit.
        last_end_ = end;
        return send_record(Type::word, utterance_, time + number(begin) + number(end));
      }
      case espeakEVENT_MARK: {
        const std::string_view name = e.id.name != nullptr ? e.id.name : "";
        return send_record(Type::mark, utterance_,
                           time + std::string(name.substr(0, wire::kMostNameBytes)));
      }
      case espeakEVENT_SENTENCE:
        return send_record(Type::sentence, utterance_, time);
      default:
        return;
    }
  }

  static Program* self;  // espeak-ng's callback has no place for one.
  wire::Reader reader_;
  StressTrace* trace_ = nullptr;
  const Script* script_ = nullptr;
  std::string language_;
  std::uint32_t utterance_ = 0, last_end_ = 0;
  std::uint64_t samples_ = 0;
  int rate_hz_ = 0;
  bool cancelled_ = false;
};

Program* Program::self = nullptr;

constexpr char kUsage[] =
    R"(caryatid-voice: speaks for caryatid, which starts it. Not for use by hand.

Requests come in, sound and its events go out over the socket on standard input, in the frames that
platform/voice/wire.h describes. Linked with espeak-ng, this program is under the GNU General Public
Licence, version 3 or later.

example: caryatid --voice /usr/bin/caryatid-voice --say "Welcome!"
)";

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    const bool asked = std::strcmp(argv[1], "--help") == 0;
    std::fputs(kUsage, asked ? stdout : stderr);
    return asked ? 0 : 2;
  }
  static Program program;
  if (!program.start()) {
    std::fputs("caryatid-voice: espeak-ng finds no data; install espeak-ng-data\n", stderr);
    return 1;
  }
  return program.run();
}
