#include "core/scene_text.hpp"

#include <algorithm>
#include <cstdint>
#include <set>

#include <quadrille/error.hpp>

#include "system/input_file.hpp"

namespace quadrille {

namespace {

using Limits = SceneTextLimits;

/// Bytes of the UTF-8 sequence at the start of the text, or 0 if there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
    std::uint32_t value = first & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        value = value << 6 | (byte(i) & 0x3f);
    }
    const bool surrogate = value >= 0xd800 && value <= 0xdfff;
    const bool tooLong = (size == 3 && value < 0x800) || (size == 4 && value < 0x10000);
    return surrogate || tooLong || value > 0x10ffff ? 0 : size;
}

bool isLetterOrDigit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}
bool isBareKey(char c) { return isLetterOrDigit(c) || c == '_' || c == '-'; }

/// Walks over the text once. Errors are at the character where it stands.
class Outline {
  public:
    Outline(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    void check() {
        checkLines();
        while (!atEnd()) {
            skipBlanks();
            if (atEnd()) return;
            if (here() == '[') {
                header();
            } else if (here() != '\n' && here() != '\r' && here() != '#') {
                keyAndValue(0);
            }
            endOfLine();
        }
    }

  private:
    bool atEnd() const { return at_ == text_.size(); }
    char here() const { return atEnd() ? '\n' : text_[at_]; }
    bool startsWith(std::string_view what) const { return text_.substr(at_).starts_with(what); }

    [[noreturn]] void fail(const std::string& reason) const { failAt(at_, reason); }

    [[noreturn]] void failAt(std::size_t at, const std::string& reason) const {
        const std::string_view before = text_.substr(0, at);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::string_view start = before.substr(before.rfind('\n') + 1);
        const auto column =
            std::count_if(start.begin(), start.end(), [](char c) { return (c & 0xc0) != 0x80; }) +
            1;
        throw SceneError(file_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " +
                         reason);
    }

    void skipBlanks() {
        while (!atEnd() && (here() == ' ' || here() == '\t')) ++at_;
    }
    void skipComment() {
        if (atEnd() || here() != '#') return;
        at_ = std::min(text_.find('\n', at_), text_.size());
    }
    void endOfLine() {
        skipBlanks();
        skipComment();
        if (!atEnd() && here() == '\r') ++at_;
        if (here() != '\n') fail("nothing but a comment may follow on this line");
        if (!atEnd()) ++at_;
    }

    /// What holds of every character, wherever it stands.
    void checkLines() const {
        std::size_t lineStart = 0;
        for (std::size_t i = 0; i < text_.size();) {
            const auto c = static_cast<unsigned char>(text_[i]);
            if (c == '\n') lineStart = i + 1;
            if (i - lineStart == Limits::line) {
                failAt(i, "a line has at most " + std::to_string(Limits::line) + " bytes");
            }
            const bool lineBreak = c == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
            if ((c < ' ' && c != '\t' && c != '\n' && !lineBreak) || c == 0x7f) {
                failAt(i, "has a control character");
            }
            const std::size_t size = sequenceLength(text_.substr(i));
            if (size == 0) failAt(i, "is not UTF-8");
            i += size;
        }
    }

    void header() {
        const std::size_t start = at_;
        const bool array = startsWith("[[");
        at_ += array ? 2 : 1;
        skipBlanks();
        key();
        const std::string_view end = array ? "]]" : "]";
        if (!startsWith(end)) fail("must be '" + std::string(end) + "'");
        at_ += end.size();
        headers_.insert(text_.substr(start, at_ - start));
        if (headers_.size() > Limits::headers) {
            failAt(start,
                   "a scene has at most " + std::to_string(Limits::headers) + " different tables");
        }
    }

    /// With the blanks behind it.
    void key() {
        const std::size_t start = at_;
        for (std::size_t parts = 1;; ++parts) {
            if (here() == '"' || here() == '\'') {
                if (startsWith("\"\"\"") || startsWith("'''")) fail("a key stays on its line");
                shortString();
            } else if (!atEnd() && isBareKey(here())) {
                while (!atEnd() && isBareKey(here())) ++at_;
            } else {
                fail("must be a key: letters, digits, '_', '-', or text in quotes");
            }
            if (at_ - start > Limits::key) {
                failAt(start, "a key has at most " + std::to_string(Limits::key) + " bytes");
            }
            skipBlanks();
            if (here() != '.') return;
            if (parts == 1 && ++dotted_ > Limits::dotted) {
                failAt(start, "a scene has at most " + std::to_string(Limits::dotted) +
                                  " keys with a dot");
            }
            if (parts == Limits::keyParts) {
                failAt(start, "a key has at most " + std::to_string(Limits::keyParts) + " parts");
            }
            ++at_;
            skipBlanks();
        }
    }

    void keyAndValue(std::size_t depth) {
        key();
        if (here() != '=') fail("must be '='");
        ++at_;
        skipBlanks();
        value(depth);
    }

    void value(std::size_t depth) {
        if (here() == '[' || here() == '{') {
            if (depth == Limits::nesting) {
                fail("values lie at most " + std::to_string(Limits::nesting) + " deep");
            }
            here() == '[' ? array(depth + 1) : inlineTable(depth + 1);
        } else if (startsWith("\"\"\"") || startsWith("'''")) {
            longString();
        } else if (here() == '"' || here() == '\'') {
            shortString();
        } else {
            word();
        }
    }

    void skipLines() {
        while (!atEnd()) {
            skipBlanks();
            skipComment();
            if (atEnd() || (here() != '\n' && here() != '\r')) return;
            ++at_;
        }
    }

    void array(std::size_t depth) {
        const std::size_t start = at_++;
        while (true) {
            skipLines();
            if (atEnd()) failAt(start, "the array does not end");
            if (here() == ']') break;
            value(depth);
            skipLines();
            if (atEnd()) failAt(start, "the array does not end");
            if (here() == ']') break;
            if (here() != ',') fail("must be ',' or ']'");
            ++at_;
        }
        ++at_;
    }

    void inlineTable(std::size_t depth) {
        ++at_;
        skipBlanks();
        if (here() != '}') {
            keyAndValue(depth);
            for (skipBlanks(); here() == ','; skipBlanks()) {
                ++at_;
                skipBlanks();
                keyAndValue(depth);
            }
        }
        if (here() != '}') fail("must be ',' or '}', on the line of the '{'");
        ++at_;
    }

    void shortString() {
        const std::size_t start = at_;
        const char quote = text_[at_++];
        while (here() != quote) {
            if (quote == '"' && here() == '\\') ++at_;
            if (here() == '\n') failAt(start, "the text does not end on its line");
            ++at_;
        }
        ++at_;
    }

    void longString() {
        const std::size_t start = at_;
        const std::string_view quotes = text_.substr(at_, 3);
        for (at_ += 3; !startsWith(quotes); ++at_) {
            if (!atEnd() && quotes[0] == '"' && here() == '\\') ++at_;
            if (atEnd()) failAt(start, "the text does not end");
        }
        at_ += 3;
        // One or two more belong to the text.
        for (int i = 0; i < 2 && !atEnd() && here() == quotes[0]; ++i) ++at_;
    }

    /// A number, true or false.
    void word() {
        const std::size_t start = at_;
        while (!atEnd()) {
            const bool sign = here() == '+' || here() == '-';
            const bool signFits = at_ == start || text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E';
            if (sign ? !signFits : !isLetterOrDigit(here()) && here() != '_' && here() != '.')
                break;
            ++at_;
        }
        if (at_ == start) fail("must be a value");
        if (at_ - start > Limits::number) {
            failAt(start, "a number has at most " + std::to_string(Limits::number) + " characters");
        }
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
    std::size_t dotted_ = 0;
    std::set<std::string_view> headers_;
};

}  // namespace

std::string readSceneText(const std::filesystem::path& file) {
    std::string text;
    try {
        text = readRegularFile(file, SceneTextLimits::bytes);
    } catch (const Error& error) {
        throw SceneError(file.string() + ": " + error.what());
    }
    dropByteOrderMark(text);
    checkSceneText(text, file.string());
    return text;
}

void checkSceneText(std::string_view text, const std::string& file) { Outline(text, file).check(); }

}  // namespace quadrille
