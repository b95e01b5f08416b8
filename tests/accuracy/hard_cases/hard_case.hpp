#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

/// The hard cases: scenes whose exact outcome is known (accuracy.md, sections 4 and 5), and what
/// each law makes of them.
namespace quadrille::accuracy {

/// What a case is tried with.
struct Setup {
    Law law;
    Precision precision;

    bool isDouble() const { return precision == Precision::Double; }
    /// A tolerance that stands for rounding: one for each precision.
    double rounding(double inDouble, double inFloat) const {
        return isDouble() ? inDouble : inFloat;
    }
};

/// What came out.
struct Outcome {
    std::string text;    ///< "exact", or in a few words what happened instead
    std::string detail;  ///< the figures behind it, for who reads a failure
};

/// Texts of both precisions.
struct Texts {
    std::string inDouble, inFloat;

    Texts(const char* both) : inDouble(both), inFloat(both) {}
    Texts(const char* d, const char* f) : inDouble(d), inFloat(f) {}
    const std::string& of(Precision precision) const {
        return precision == Precision::Double ? inDouble : inFloat;
    }
};

struct HardCase {
    std::string name;   ///< of the test
    std::string title;  ///< of the row in docs/accuracy.md
    std::function<Outcome(const Setup&)> run;
    Texts baseline, impulse, continuous;  ///< the expected outcomes

    const Texts& expected(Law law) const;
};

/// All cases, in the order of the table.
const std::vector<HardCase>& hardCases();

// The cases by theme; each theme is a file.
std::vector<HardCase> chainCases();
std::vector<HardCase> cornerCases();
std::vector<HardCase> extremeCases();
std::vector<HardCase> overlapCases();
std::vector<HardCase> gravityCases();
std::vector<HardCase> borderCases();
std::vector<HardCase> crowdCases();
std::vector<HardCase> inputCases();
std::vector<HardCase> billiardCases();

/// The table law x case x precision, in Markdown.
std::string outcomeTable();

// ---- what the cases are built with

struct Body {
    Vec2 position, velocity{0, 0};
    Vec2 size{1, 1};
    double mass = 1;
    bool isStatic = false;
};

struct Conditions {
    StepSettings step{};
    Vec2 world{1000, 1000};
};

/// `baseline` resolves a pair once in every cell that the pair shares, so it is tried with one cell
/// for all; the other laws give the same bits on every partitioner.
PartitionerConfig partitionerFor(Law law);

Simulation simulate(const Setup& setup, const std::vector<Body>& bodies,
                    const Conditions& conditions = {});

/// Of the entity with index i: the bodies of `simulate` in the order given.
Vec2 position(const Simulation& sim, std::size_t i);
Vec2 velocity(const Simulation& sim, std::size_t i);

/// Collisions seen so far.
class ContactLog {
  public:
    explicit ContactLog(Simulation& sim);
    const std::vector<Contact>& collisions() const { return *collisions_; }

  private:
    // The listener outlives a move of the log.
    std::shared_ptr<std::vector<Contact>> collisions_;
};

// ---- words

/// "exact" if `holds`, else `instead`.
Outcome exactIf(bool holds, std::string instead, std::string detail = {});

/// A number with so many significant digits.
std::string number(double value, int digits = 3);
/// "+12 %", "-0.5 %": a relative change, two significant digits.
std::string percent(double ratio);
/// The power of ten just above a magnitude: "1e-12".
std::string belowPower(double value);
std::string listing(const std::vector<double>& values);

}  // namespace quadrille::accuracy
