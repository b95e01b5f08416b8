#pragma once

/// Everything that a program that uses Quadrille needs.

#include <quadrille/bodies.hpp>
#include <quadrille/body_ref.hpp>
#include <quadrille/cells.hpp>
#include <quadrille/components.hpp>
#include <quadrille/config.hpp>
#include <quadrille/contact.hpp>
#include <quadrille/creation_ranks.hpp>
#include <quadrille/device.hpp>
#include <quadrille/entity.hpp>
#include <quadrille/error.hpp>
#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/random.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>
#include <quadrille/step_report.hpp>
#include <quadrille/version.hpp>
#include <quadrille/world.hpp>
