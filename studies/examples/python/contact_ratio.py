#!/usr/bin/env python3
"""Contact ratio against noise: macro-geometry at one centre distance and ratio, which no study file can vary.

Each variant has its own number of teeth, helix angle and addendum; the module follows from the centre distance. For each the transmission error
under load is found, and how loud it would be: the level of its harmonics at the mesh frequency, those of higher order weighted by their frequency,
in decibel over 1 um.

    ./studies/run studies/examples/python/contact_ratio.py                # thin slices, some minutes for 1,000 variants
    ./studies/run studies/examples/python/contact_ratio.py --quick        # 12 variants
"""

import argparse
import csv
import itertools
import math

import numpy as np

import flankwright as fw

CENTRE_DISTANCE, RATIO, FACE_WIDTH, TORQUE = 150.0, 2.0, 40.0, 300.0  # mm, -, mm, N·m


def study(pinion_teeth, helix_angle, addendum, compliance):
    """A pair without profile shift that fills the centre distance: m_n = 2 a cos(beta) / (z1 + z2)."""
    wheel_teeth = round(RATIO * pinion_teeth)
    rack = {"addendum": addendum, "dedendum": addendum + 0.25, "root_radius": 0.25}
    relief = {"amount": 12.0, "height": 0.4 * addendum, "shape": "parabolic"}
    gear = {"face_width": FACE_WIDTH, "rack": rack, "modification": {"tip_relief": relief, "lead_crowning": 5.0}}
    return {
        "title": f"{pinion_teeth}/{wheel_teeth}, {helix_angle:g} deg, addendum {addendum:g}",
        "pair": {
            "normal_module": 2.0 * CENTRE_DISTANCE * math.cos(math.radians(helix_angle)) / (pinion_teeth + wheel_teeth),
            "helix_angle": helix_angle,
        },
        "pinion": gear | {"teeth": pinion_teeth},
        "wheel": gear | {"teeth": wheel_teeth},
        "load": {"torque": TORQUE},
        "fidelity": {"compliance": compliance, "effect_sizes": "off", "quadrature": {"rule": "graded", "intervals": 8}},
        "cycle": {"positions": 32},
    }


def level(harmonics):
    """Sum of the harmonics, each by its order, in decibel over 1 um."""
    return 10.0 * math.log10(np.sum((np.arange(1, harmonics.size + 1) * harmonics) ** 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="12 variants")
    parser.add_argument("--compliance", default="thin_slice", help="thin_slice, or fitted: finite elements of each variant, half a minute each")
    parser.add_argument("--csv", help="file for all variants")
    options = parser.parse_args()

    teeth = (20, 30) if options.quick else range(20, 40)
    angles = (0.0, 15.0, 30.0) if options.quick else np.linspace(0.0, 32.0, 10)
    addenda = (1.0, 1.2) if options.quick else (1.0, 1.1, 1.2, 1.3, 1.4)
    rows = []
    for z, angle, addendum in fw.track(list(itertools.product(teeth, angles, addenda)), "variants"):
        variant = study(int(z), float(angle), float(addendum), options.compliance)
        try:
            results = fw.analyse(variant)
        except fw.InvalidInput as error:  # pointed tips, undercut: no gear
            print(f"{variant['title']}: {error.key} = {error.value}: {error.allowed}")
            continue
        rows.append(
            {
                "variant": variant["title"],
                "transverse contact ratio": results["geometry.transverse_contact_ratio"],
                "overlap ratio": results["geometry.overlap_ratio"],
                "total contact ratio": results["geometry.total_contact_ratio"],
                "te peak to peak [um]": results["loaded.0.summary.te_peak_to_peak_um"],
                "level [dB]": level(results["loaded.0.summary.te_harmonics_um"]),
                "contact stress [MPa]": results["loaded.0.summary.peak_contact_stress_MPa"],
            }
        )

    rows.sort(key=lambda row: row["level [dB]"])
    print(f"\n{'variant':<32}{'eps_alpha':>10}{'eps_beta':>10}{'eps_gamma':>10}{'TE p-p um':>11}{'level dB':>10}{'stress MPa':>12}")
    for row in rows[:12]:
        name, *numbers = row.values()
        print(f"{name:<32}" + "".join(f"{number:>{width}.2f}" for number, width in zip(numbers, (10, 10, 10, 11, 10, 12))))
    print("\nmean level by total contact ratio")
    ratios = np.array([row["total contact ratio"] for row in rows])
    levels = np.array([row["level [dB]"] for row in rows])
    for low in np.arange(math.floor(2.0 * ratios.min()) / 2.0, ratios.max(), 0.5):
        inside = (ratios >= low) & (ratios < low + 0.5)
        if inside.any():
            print(f"{low:.1f} .. {low + 0.5:.1f}  {levels[inside].mean():7.1f} dB  best {levels[inside].min():7.1f} dB  {inside.sum():5d} variants")
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
