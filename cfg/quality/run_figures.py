"""Figures of one variant of a run (out/run/results.json), as README.md and the accuracy gate quote them."""

LENGTHS, ANGLES = ('x_mm', 'y_mm', 'z_mm'), ('yaw_deg', 'pitch_deg', 'roll_deg')


def worst(variant, axes, moment):
    return max(abs(variant[axis][moment]) for axis in axes)


FIGURES = {
    'std_mm': lambda v: worst(v, LENGTHS, 'std'),
    'std_deg': lambda v: worst(v, ANGLES, 'std'),
    'mean_mm': lambda v: worst(v, LENGTHS, 'mean'),
    'mean_deg': lambda v: worst(v, ANGLES, 'mean'),
    'rms_mm': lambda v: v['rms_mm'],
    'rms_deg': lambda v: v['rms_deg'],
    'over_bound_mm': lambda v: v['rms_mm'] / v['crlb_mm'],
    'over_bound_deg': lambda v: v['rms_deg'] / v['crlb_deg'],
    'nees': lambda v: v['nees'],
    'edge_on_roll_deg': lambda v: v['edge_on']['roll_std_deg'],
    'edge_on_axial_mm': lambda v: v['edge_on']['axial_std_mm'],
    'lost': lambda v: v['lost'],
    'wrong': lambda v: v['wrong'],
    'settled_lost': lambda v: v['settled']['lost'],
    'settled_invalid': lambda v: v['settled']['invalid'],
    'settled_degps': lambda v: v['settled']['rms_degps'],
    'settled_mmps': lambda v: v['settled']['rms_mmps'],
}
