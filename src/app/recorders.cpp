#include "app/recorders.hpp"

namespace quadrille::app {

FrameRecorder::FrameRecorder(const std::string& file) : out_(file) {
    out_.stream() << "frame,time,ms,contacts,collisions,pairs_tested,rebuilt,cells,"
                     "kinetic_energy\n";
}

void FrameRecorder::record(const Simulation& simulation, const StepReport& report,
                           double milliseconds) {
    out_.stream() << report.step << ',' << exact(simulation.time()) << ',' << exact(milliseconds)
                  << ',' << report.contacts << ',' << report.collisions << ',' << report.pairsTested
                  << ',' << int(report.rebuilt) << ',' << simulation.cells().size() << ','
                  << exact(kineticEnergy(simulation.world())) << '\n';
}

EventRecorder::EventRecorder(const std::string& file) : out_(file) {
    out_.stream() << "t,i,j,axis\n";
}

void EventRecorder::record(const Contact& contact) {
    if (!contact.collided) return;
    out_.stream() << exact(contact.time) << ',' << contact.rowA << ',' << contact.rowB << ','
                  << int(contact.axis) << '\n';
}

void writeState(OutputFile& out, const World& world) {
    std::ostream& stream = out.stream();
    stream << "entity,x,y,vx,vy\n";
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            stream << i << ',' << exact(m.x[i]) << ',' << exact(m.y[i]) << ',' << exact(m.vx[i])
                   << ',' << exact(m.vy[i]) << '\n';
        }
    });
    out.commit();
}

}  // namespace quadrille::app
