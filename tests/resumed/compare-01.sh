# The comparison of trial.py: what rounding leaves of nothing, and the choice between two points
# that share an extreme, are no differences; all else is.
program=$1 root=$2 folder=$3
PYTHONPATH=$root/tests/resumed /usr/bin/python3 -B - <<'PYTHON'
from trial import Wrong, compare, unit_of

for column, unit in {
        "momentum/x_N_s_per_m": "N s/m", "momentum x (N s/m)": "N s/m", "momentum/x_N_s": "N s",
        "momentum/angular_N_m_s_per_m": "N s/m", "angular momentum (N m s/m)": "N s/m",
        "moment footing (N m/m)": "N/m", "state/mass_kg_per_m": "kg/m", "mass (kg/m)": "kg/m",
        "state/largest_speed_m_per_s": "m/s", "points/displacement_1_y_m": "m",
        "state/volume_m2": "m2", "volume (m^2)": "m2", "extremes/p_Pa_least": "Pa",
        "energy/kinetic_J_per_m": "J/m", "explicit/smallest_step_s": "s", "time_s": "s",
        "motion/put_back_max_m": "m", "energy/loss_to_released": "", "size/points": "",
        "size/dofs": "", "extremes/eps_xx_most": ""}.items():
    assert unit_of(column) == unit, (column, unit_of(column))

alone = {"statistics.csv, line 1, momentum y (N s/m)": 500., "momentum/x_N_s_per_m": 1e-12,
         "momentum/angular_N_m_s_per_m": -3e-13, "energy/loss_to_released": 3e-16,
         "statistics.csv, line 1, limiting point x (m)": 0.25, "size/points": 400.,
         "statistics.csv, line 1, smallest step (s)": 1e-4, "state/x_largest_m": 2.,
         "energy/kinetic_J_per_m": 7., "explicit/smallest_step_s": 1e-4}
as_well = {"momentum/x_N_s_per_m": 4e-10, "momentum/angular_N_m_s_per_m": 2e-9,
           "energy/loss_to_released": -4e-14,
           "statistics.csv, line 1, limiting point x (m)": 0.75,
           "statistics.csv, line 1, smallest step (s)": 1e-4 * (1. + 3e-11)}
compare((alone, []), ({**alone, **as_well}, []), 1e-10)
for name, value in {"momentum/x_N_s_per_m": 1e-7, "state/x_largest_m": 2. + 1e-9,
                    "energy/kinetic_J_per_m": 7.00001, "energy/loss_to_released": 1e-9,
                    "size/points": 401., "explicit/smallest_step_s": 1.00001e-4,
                    "statistics.csv, line 1, momentum y (N s/m)": float("nan")}.items():
    try:
        compare((alone, []), ({**alone, name: value}, []), 1e-10)
    except Wrong as problem:
        assert name in str(problem), problem
    else:
        raise AssertionError(name)
# What must be the same bit by bit is compared with all its digits.
for name, value in as_well.items():
    try:
        compare((alone, []), ({**alone, name: value}, []), 0.)
        raise AssertionError(name)
    except Wrong:
        pass
PYTHON
