#!/usr/bin/env python3
"""A gear mesh as a component of OpenMDAO: inputs, outputs and exact partial derivatives, without finite differences.

The class is an OpenMDAO ExplicitComponent where OpenMDAO is installed. Without it a stand-in of a few lines takes its place, so that this file runs by
itself: it compares the partials with central differences.

    ./studies/run studies/examples/python/openmdao_component.py
"""

import numpy as np

import flankwright as fw

try:
    from openmdao.api import ExplicitComponent
except ImportError:

    class ExplicitComponent:
        """What this example needs of OpenMDAO's class of that name."""

        def __init__(self, **options):
            self.options, self.inputs, self.outputs, self.partials = options, {}, {}, {}
            self.setup()

        def add_input(self, name, val=1.0, units=None, desc=""):
            self.inputs[name] = np.atleast_1d(float(val))

        def add_output(self, name, val=1.0, units=None, desc=""):
            self.outputs[name] = np.atleast_1d(float(val))

        def declare_partials(self, of, wrt):
            for output in self.outputs:
                for given in self.inputs:
                    self.partials[output, given] = np.zeros((1, 1))


#: Names of inputs and outputs, with what they are in a study and in results.json; "um" is micrometre in OpenMDAO too.
INPUTS = {
    "lead_crowning": ("pinion.modification.lead_crowning", "um", 6.0),
    "tip_relief": ("pinion.modification.tip_relief.amount", "um", 12.0),
    "mesh_misalignment": ("misalignment.mesh_misalignment", "um", 8.0),
    "torque": ("load.torque", "N*m", 250.0),
}
OUTPUTS = {
    "te_mean": ("loaded.0.summary.te_mean_um", "um"),
    "te_peak_to_peak": ("loaded.0.summary.te_peak_to_peak_um", "um"),
    "contact_stress": ("loaded.0.summary.peak_contact_stress_MPa", "MPa"),
}

STUDY = {
    "title": "Mesh in OpenMDAO",
    "pair": {"normal_module": 3.0, "helix_angle": 15.0},
    "pinion": {"teeth": 20, "face_width": 30.0, "modification": {"lead_crowning": 6.0, "tip_relief": {"amount": 12.0, "height": 1.5, "shape": "parabolic"}}},
    "wheel": {"teeth": 41, "face_width": 30.0},
    "load": {"torque": 250.0},
    "fidelity": {"compliance": "thin_slice", "effect_sizes": "off", "quadrature": {"rule": "graded", "intervals": 8}},
    "cycle": {"positions": 24},
    "analyse": {"gradients": [path for path, _, _ in INPUTS.values()]},
}


class GearMesh(ExplicitComponent):
    """Transmission error and contact stress of a pair as functions of its modifications, misalignment and torque."""

    def setup(self):
        self.study = fw.Study(STUDY)
        self.at, self.results = None, None
        for name, (path, unit, value) in INPUTS.items():
            self.add_input(name, val=value, units=unit, desc=path)
        for name, (quantity, unit) in OUTPUTS.items():
            self.add_output(name, units=unit, desc=quantity)
        self.declare_partials("*", "*")

    def run(self, inputs):
        """One analysis gives outputs and partials; the same point is not analysed twice."""
        at = {path: float(np.ravel(inputs[name])[0]) for name, (path, _, _) in INPUTS.items()}
        if at != self.at:
            self.results, self.at = fw.analyse(self.study.replace(at)), at
        return self.results

    def compute(self, inputs, outputs):
        results = self.run(inputs)
        for name, (quantity, _) in OUTPUTS.items():
            outputs[name] = results[quantity]

    def compute_partials(self, inputs, partials):
        results = self.run(inputs)
        for output, (quantity, _) in OUTPUTS.items():
            for given, derivative in zip(INPUTS, results.gradient(quantity)):
                partials[output, given] = derivative


def main():
    mesh = GearMesh()
    if hasattr(mesh, "_var_rel_names"):  # OpenMDAO's own check
        from openmdao.api import Problem

        problem = Problem(mesh)
        problem.setup()
        problem.run_model()
        problem.check_partials(method="fd", form="central", step=1e-3, compact_print=True)
        return
    inputs, outputs, partials = mesh.inputs, mesh.outputs, mesh.partials
    mesh.compute(inputs, outputs)
    mesh.compute_partials(inputs, partials)
    print(f"{'partials':<18}{'with respect to':<20}{'exact':>14}{'difference':>14}")
    for output in OUTPUTS:
        for given, step in zip(INPUTS, (1e-3, 1e-3, 1e-3, 1e-2)):
            values = []
            for sign in (1.0, -1.0):
                moved = {name: value + (sign * step if name == given else 0.0) for name, value in inputs.items()}
                mesh.compute(moved, outputs)
                values.append(float(np.ravel(outputs[output])[0]))
            exact, difference = float(np.ravel(partials[output, given])[0]), (values[0] - values[1]) / (2.0 * step)
            print(f"{output:<18}{given:<20}{exact:>14.6g}{difference:>14.6g}")
            assert abs(exact - difference) <= 1e-3 * max(abs(exact), abs(difference), 1e-3), "a partial derivative differs"


if __name__ == "__main__":
    main()
