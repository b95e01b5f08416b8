// What would overrun the TOML parser, or meet one of its faults, must end before it does.
#include "core/scene_text.hpp"

#include <gtest/gtest.h>
#include <string>

#include <quadrille/scene.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

using Limits = SceneTextLimits;

const std::string open = "format = 1\n[world]\nsize = [100, 50]\n";

std::string repeated(const std::string& piece, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) result += piece;
    return result;
}

class SceneText : public testing::Test {
  protected:
    /// The error of the file goes on with this behind its name.
    void expectRefused(const std::string& text, const std::string& where) const {
        SCOPED_TRACE(text.substr(0, 80));
        const auto file = folder_.write("scene.toml", text);
        const std::string error = errorOf<SceneError>([&] { loadScene(file); });
        const std::string expected = file.string() + where;
        EXPECT_EQ(error.substr(0, expected.size()), expected) << error;
    }
    void expectTaken(const std::string& text) const {
        SCOPED_TRACE(text.substr(0, 80));
        const auto file = folder_.write("scene.toml", text);
        EXPECT_EQ(errorOf<SceneError>([&] { loadScene(file); }), "");
    }

    TemporaryFolder folder_;
};

TEST_F(SceneText, KeysAreBounded) {
    expectRefused(open + repeated("a.", 30'000) + "a = 1", ":4:1: a key has");
    expectRefused(open + "[" + repeated("a.", 30'000) + "a]", ":4:2: a key has");
    expectRefused(open + "[[" + repeated("\"\".", 20'000) + "a]]", ":4:3: a key has");
    expectRefused(open + "a = {" + repeated("a.", 30'000) + "a = 1}", ":4:6: a key has");
    expectRefused(open + std::string(Limits::key + 1, 'k') + " = 1", ":4:1: a key has");
    expectRefused(open + repeated(".", 400'000) + " = 1", ":4:");
    expectRefused(open + repeated("a.", Limits::keyParts) + "a = 1", ":4:1: a key has");
    // Up to the limits it is for the scene to say that it knows no such key.
    expectRefused(open + repeated("a.", Limits::keyParts - 1) + "a = 1", ":4:1: world.a: ");
    expectRefused(open + std::string(Limits::key, 'k') + " = 1", ":4:");
}

TEST_F(SceneText, NestingIsBounded) {
    for (const std::string brackets : {"[", "{a = ", "[{a = "}) {
        expectRefused(open + "a = " + repeated(brackets, 30'000), ":4:");
        expectRefused(open + "a = " + repeated(brackets, Limits::nesting + 1), ":4:");
    }
    expectRefused(
        open + "a = " + repeated("[", Limits::nesting + 1) + repeated("]", Limits::nesting + 1),
        ":4:" + std::to_string(5 + Limits::nesting) + ": values lie at most");
    expectRefused(open + "a = " + repeated("[", Limits::nesting) + repeated("]", Limits::nesting),
                  ":4:5: world.a: ");
}

TEST_F(SceneText, LinesAreBounded) {
    expectRefused(open + "# " + std::string(Limits::line, 'c'), ":4:");
    expectTaken(open + "# " + std::string(Limits::line - 3, 'c'));
    expectRefused(open + "a = \"" + std::string(Limits::line, 'c') + "\"", ":4:");
}

TEST_F(SceneText, FilesAreBounded) {
    expectRefused(open + repeated("# comment\n", Limits::bytes / 10), ": has ");
    expectTaken(open + repeated("# comment\n", Limits::bytes / 10 - 10));
}

/// The parser looks for each of these in a list of all.
TEST_F(SceneText, WhatTakesTheSquareOfItsNumberIsBounded) {
    std::string keys = open, tables = open;
    for (int i = 0; i < 200'000; ++i) {
        keys += "a" + std::to_string(i) + ".b = 1\n";
        tables += "[[a" + std::to_string(i) + "]]\n";
    }
    expectRefused(keys, ":" + std::to_string(4 + Limits::dotted) + ":1: ");
    expectRefused(tables, ":" + std::to_string(3 + Limits::headers) + ":1: ");
    std::string bodies = open;
    for (int i = 0; i < 2'000; ++i) bodies += "[[body]]\nposition = [0, 0]\nsize = [1, 1]\n";
    expectTaken(bodies);
}

TEST_F(SceneText, HeadersAreComplete) {
    for (const std::string header : {"[\n",    "[",      "[ ",     "[\n]",      "[]",
                                     "[.a]",   "[a.]",   "[a..b]", "[=]",       "[,]",
                                     "[#]",    "[[",     "[[\n]]", "[[]]",      "[[a]\n]",
                                     "[ [a]]", "[[a] ]", "[a\n]",  "[\"a\n\"]", "[\"\"\"a\"\"\"]",
                                     "[a] b"}) {
        expectRefused(open + header, ":4:");
    }
}

TEST_F(SceneText, BracketsMatch) {
    for (const std::string value :
         {"[}",       "[1}",        "{]",       "{a = }",   "{a = ]}", "[,]",  "[1,,2]", "{,}",
          "{a = 1,}", "{a = 1,\n}", "{\n}",     "]",        "}",       ",",    "#",      "",
          "=",        "[1 2]",      "[=]",      "[1",       "[1,",     "[",    "{",      "{a",
          "{a =",     "{a = 1",     "[\n\n",    "\"",       "'",       "\"\\", "\"\\\"", "\"\"\"",
          "'''",      "\"\"\"\\",   "\"\"\"\"", "\"a\nb\"", "'a\nb'"}) {
        expectRefused(open + "a = " + value, ":4:");
    }
}

/// The parser fails its assertions on some of them, and no scene has any.
TEST_F(SceneText, DatesAreRefused) {
    for (const std::string value :
         {"2020-01-01", "2020-01-01 1", "2020-01-01 1,", "2020-01-01T00:00:00Z", "07:32:00",
          "[2020-01-01 1]", "[2020-01-01 1,]", "2020-01-01 11111111111"}) {
        expectRefused(open + "a = " + value, ":4:");
    }
    expectRefused(open + "a = 1" + std::string(Limits::number, '0'), ":4:5: a number has");
}

TEST_F(SceneText, IsUtf8) {
    for (const std::string bytes :
         {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xc3", "\xc3(", "\xe0\x80\x80", "\xe2\x82",
          "\xe2\x28\xa1", "\xed\xa0\x80", "\xed\xbf\xbf", "\xf0\x80\x80\x80", "\xf0\x9f\x98",
          "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xfe\xff"}) {
        // In a comment, in a text, as a key, as a value, and at either end of the file.
        expectRefused(open + "# \xc3\xa9 " + bytes, ":4:5: is not UTF-8");
        expectRefused(open + "a = \"" + bytes + "\"", ":4:6: is not UTF-8");
        expectRefused(open + bytes + " = 1", ":4:1: is not UTF-8");
        expectRefused(open + "a = " + bytes, ":4:5: is not UTF-8");
        expectRefused(bytes, ":1:1: is not UTF-8");
        expectRefused(bytes + open, ":1:1: is not UTF-8");
    }
    expectTaken("name = \"caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80 \xed\x9f\xbf\"\n" + open);
}

TEST_F(SceneText, OtherCharactersStayInTextAndComments) {
    for (const std::string character : {"\xc2\x85", "\xc2\xa0", "\xe2\x80\xa8", "\xc3\xa9"}) {
        expectTaken("name = \"" + character + "\"\n" + open + "# " + character);
        expectRefused(open + character + "a = 1", ":4:1: ");
        expectRefused(open + "a" + character + " = 1", ":4:2: ");
        expectRefused(open + "a = " + character + "1", ":4:5: ");
        expectRefused(open + "a = [1" + character + "]", ":4:7: ");
        expectRefused(open + "[" + character + "a]", ":4:2: ");
    }
}

TEST_F(SceneText, ControlCharactersAreRefused) {
    for (const char character : {'\0', '\x01', '\b', '\v', '\f', '\r', '\x1b', '\x7f'}) {
        const std::string text(1, character);
        expectRefused(open + "# " + text + "c", ":4:3: has a control character");
        expectRefused(open + "a = \"" + text + "\"", ":4:6: has a control character");
        expectRefused(open + text + "a = 1", ":4:1: has a control character");
    }
    expectTaken("format = 1\r\n[world]\r\nsize = [100,\t50]\r\n");
}

TEST_F(SceneText, TomlThatScenesUseIsTaken) {
    expectTaken("\xef\xbb\xbf" + open);
    expectTaken("name = 'a \"b\" \\'\n" + open);
    expectTaken("name = \"\"\"\n a \\\n  \"\" b \"\"\"\"\"\n" + open);
    expectTaken("name = '''\n a ' '' b'''''\n" + open);
    expectTaken(
        "\"format\" = 0x1\n'world'.\"size\" = [ # first\n 1_00.0e+0 , # second\n\n 5E1,\n]\n");
    expectTaken("format = +1\n world = { size = [1e2, 50], walls = {thickness = 1, inset = 2} }");
    expectTaken(open +
                "[ \"step\" ] # comment\ndt = 1e-2 #\n\t [[ body ]]\nposition = [-0, +5e1]\n"
                "size = [1, 1]");
    expectTaken(open + "[[body]]\nposition=[0,0]\nsize=[1,1]\nstatic=true");
}

}  // namespace
}  // namespace quadrille
