#include "studies/analysis/life_quantities.hpp"

#include <array>
#include <cmath>

#include "studies/base/unit_of_name.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array all_life_quantities{
    LifeQuantity{.key = "loss_factor",
                 .of_pair = &CaseLife::loss_factor,
                 .error = &CaseLifeErrors::loss_factor,
                 .column = {"H_VL", "{:.4f}"},
                 .output = Output::LossFactor,
                 .is_sampled = true},
    LifeQuantity{.key = "friction", .of_pair = &CaseLife::friction, .is_in_csv = false},
    LifeQuantity{.key = "power_W", .of_pair = &CaseLife::power, .is_in_csv = false},
    LifeQuantity{.key = "loss_power_W",
                 .of_pair = &CaseLife::loss_power,
                 .error = &CaseLifeErrors::loss_power,
                 .column = {"loss", "{:.4g}"},
                 .gradient = &CaseLife::loss_power_gradient,
                 .is_sampled = true,
                 .is_compared = true},
    LifeQuantity{.key = "film_friction", .of_pair = &CaseLife::film_friction, .is_in_csv = false},
    LifeQuantity{.key = "bulk_temperature_degC", .of_pair = &CaseLife::bulk_temperature, .is_in_csv = false},
    LifeQuantity{.key = "specific_film_thickness",
                 .of_pair = &CaseLife::film,
                 .error = &CaseLifeErrors::film,
                 .column = {"film", "{:.3f}", "lambda"},
                 .output = Output::SpecificFilmThickness,
                 .smaller_is_worse = true,
                 .is_sampled = true,
                 .is_compared = true},
    LifeQuantity{.key = "film_thickness_of_flanks", .of_pair = &CaseLife::film_of_flanks, .smaller_is_worse = true},
    LifeQuantity{.key = "micropitting_safety",
                 .of_pair = &CaseLife::micropitting_safety,
                 .error = &CaseLifeErrors::micropitting_safety,
                 .output = Output::MicropittingUtilisation,
                 .is_reciprocal = true,
                 .smaller_is_worse = true,
                 .is_sampled = true},
    LifeQuantity{.key = "flash_temperature_K",
                 .of_pair = &CaseLife::flash_temperature,
                 .error = &CaseLifeErrors::flash_temperature,
                 .output = Output::FlashTemperature,
                 .is_sampled = true},
    LifeQuantity{.key = "contact_temperature_degC",
                 .of_pair = &CaseLife::contact_temperature,
                 .error = &CaseLifeErrors::contact_temperature,
                 .column = {"theta_B", "{:.1f}"},
                 .output = Output::ContactTemperature,
                 .is_sampled = true,
                 .is_compared = true},
    LifeQuantity{.key = "flank_temperature_degC", .of_pair = &CaseLife::flank_temperature},
    LifeQuantity{.key = "hottest_z_mm", .of_pair = &CaseLife::hottest_z, .is_in_csv = false},
    LifeQuantity{.key = "hottest_pinion_radius_mm", .of_pair = &CaseLife::hottest_pinion_radius, .is_in_csv = false},
    LifeQuantity{.key = "scuffing_safety",
                 .of_pair = &CaseLife::scuffing_safety,
                 .error = &CaseLifeErrors::scuffing_safety,
                 .column = {"S_B", "{:.2f}", "scuffing"},
                 .output = Output::ScuffingUtilisation,
                 .is_reciprocal = true,
                 .smaller_is_worse = true,
                 .is_sampled = true},
    LifeQuantity{.key = "contact_safety",
                 .of_gears = &CaseLife::contact_safety,
                 .column = {"contact", "{:.2f}", "safety"},
                 .smaller_is_worse = true,
                 .is_sampled = true,
                 .is_compared = true},
    LifeQuantity{.key = "root_safety",
                 .of_gears = &CaseLife::root_safety,
                 .column = {"root", "{:.2f}", "safety"},
                 .smaller_is_worse = true,
                 .is_sampled = true,
                 .is_compared = true},
    LifeQuantity{.key = "contact_damage",
                 .of_gears = &CaseLife::contact_damage,
                 .of_spectrum = &SpectrumLife::contact,
                 .column = {"contact", "{:.3g}", "damage"},
                 .output = Output::ContactDamage},
    LifeQuantity{.key = "root_damage",
                 .of_gears = &CaseLife::root_damage,
                 .of_spectrum = &SpectrumLife::root,
                 .column = {"root", "{:.3g}", "damage"},
                 .output = Output::RootDamage},
    LifeQuantity{.key = "sigma_H_MPa", .of_gears = &CaseLife::iso_contact},
    LifeQuantity{.key = "sigma_F_MPa", .of_gears = &CaseLife::iso_root},
    LifeQuantity{.key = "S_H",
                 .of_gears = &CaseLife::iso_contact_safety,
                 .column = {"S_H", "{:.2f}", "ISO 6336"},
                 .smaller_is_worse = true,
                 .is_compared = true},
    LifeQuantity{
        .key = "S_F", .of_gears = &CaseLife::iso_root_safety, .column = {"S_F", "{:.2f}", "ISO 6336"}, .smaller_is_worse = true, .is_compared = true},
};

}  // namespace

std::string_view LifeQuantity::unit() const { return unit_of_name(key); }

double LifeQuantity::of(const CaseLife& life, Member member) const { return of_gears != nullptr ? (life.*of_gears)[member] : life.*of_pair; }

double LifeQuantity::worst(const CaseLife& life) const {
  const double pinion = of(life, Member::Pinion), wheel = of(life, Member::Wheel);
  return smaller_is_worse ? std::fmin(pinion, wheel) : std::fmax(pinion, wheel);
}

std::span<const LifeQuantity> life_quantities() { return all_life_quantities; }

}  // namespace flankwright::studies
