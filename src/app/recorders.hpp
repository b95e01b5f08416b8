#pragma once

#include <string>

#include <quadrille/quadrille.hpp>

#include "app/output_file.hpp"
#include "app/run_beside.hpp"

namespace quadrille::app {

/// Observers that write a run down as CSV.

/// A row a frame.
class FrameRecorder {
  public:
    explicit FrameRecorder(const std::string& file);
    void record(const Simulation& simulation, const StepReport& report, double milliseconds);
    void commit() { out_.commit(); }

  private:
    OutputFile out_;
};

/// A row for every time at which two compared runs meet.
class ComparisonRecorder {
  public:
    explicit ComparisonRecorder(const std::string& file);
    void record(const ComparedFrame& frame);
    void commit() { out_.commit(); }

  private:
    OutputFile out_;
};

/// A row for every collision: t,i,j,axis with i, j in order of creation, static bodies counted down
/// from -1, and axis 1 = x, 2 = y, 3 = both; then impulse (kg px/s) and speed of approach (px/s)
/// along each axis.
class EventRecorder {
  public:
    explicit EventRecorder(const std::string& file);
    void record(const Contact& contact);
    void commit() { out_.commit(); }

  private:
    OutputFile out_;
};

/// A row for every moving body in order of creation: entity,x,y,vx,vy in the shortest form that
/// reads back exactly.
void writeState(OutputFile& file, const World& world);

}  // namespace quadrille::app
