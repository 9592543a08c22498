#!/usr/bin/env python3
"""Makes validation/sliding/sliding_cases.json: python3 make_cases.py FOLDER_OF_objects_ref.py (needs gmpy2).

Slides of blocks and casters by `slide` of objects_ref.py in 160-bit arithmetic, under the records of
validation/rocking, in the layout of object_cases.json: `args` is a command line of freestand.  `amplification` is the
relative change of the answer over that of the motion, by a second run with the motion multiplied by 1 + 1e-6.  Without
kinetic friction one sine would end its slide exactly at the threshold mu_s g, which rounding decides: there mu_k is mu_s/20."""
import json, math, os, random, sys

sys.path.insert(0, sys.argv[1])
import objects_ref as ref

HERE = os.path.dirname(os.path.abspath(__file__))
RECORDS = os.path.join(HERE, '..', 'rocking', 'records')
random.seed(20261122)
G = 9.80665
EPS = 1e-6

def number(x):
    return None if x is None else float(x)

def solve(columns, dt, scale, scale_v, mu_s, mu_k, left, right):
    av = columns[1] if scale_v is not None else None
    return ref.slide(dt, columns[0], mu_s, mu_k, av=av, scale=scale, scale_v=scale_v or 1.0, clear_left=left, clear_right=right)

def expected(r):
    return dict(outcome='slid' if r['episodes'] else 'no-uplift', slide_peak_m=number(r['peak']), slide_final_m=number(r['final']),
                slide_path_m=number(r['path']), slide_speed_max_m_s=number(r['vmax']), slide_peak_time_s=number(r['t_peak']),
                first_slide_time_s=number(r['t_first']), slide_count=r['episodes'], clearance_time_s=number(r['t_clear']),
                clearance_speed_m_s=number(r['v_clear']))

def change(a, b):
    """largest relative change of the quantities that a test compares"""
    worst = 0.0
    for key in ('slide_peak_m', 'slide_final_m', 'slide_path_m', 'slide_speed_max_m_s', 'clearance_speed_m_s'):
        if (a[key] is None) != (b[key] is None): return math.inf
        if a[key] is None: continue
        scale = a['slide_speed_max_m_s'] if key.endswith('_s') else abs(a['slide_path_m'])
        if scale > 0: worst = max(worst, abs(a[key] - b[key]) / scale)
    return worst / EPS

# (record, group, peak acceleration / (mu_s g)): just over the threshold, usual, far over it
PLAN = [(record, group, ratio) for record in ('onesine_T0.4', 'onesine_T1.0', 'onecosine_T0.8', 'decsine_f1.25', 'synthfloor', 'synthfloor_hv', 'bench4000')
        for group, ratio in (('slide', 1.001), ('slide', 3.0), ('static-kinetic', 1.2), ('static-kinetic', 5.0), ('casters', 25.0), ('frictionless', 4.0), ('clearance', 2.5))]
cases = []
for record, group, ratio in PLAN:
    dt, columns = ref.load_csv(os.path.join(RECORDS, record + '.csv'))
    peak = max(abs(a) for a in columns[0])
    mu_s = random.choice([0.005, 0.01, 0.02, 0.05]) if group == 'casters' else round(random.uniform(0.05, 0.5), 3)
    mu_k = {'static-kinetic': round(mu_s * random.uniform(0.4, 0.99), 4), 'frictionless': round(mu_s / 20, 5) if record.startswith('onesine') else 0.0}.get(group)
    scale = float(f'{ratio * mu_s * G / peak:.6g}')
    scale_v = random.choice([2.0, 4.0]) if len(columns) == 2 else None
    t = round(random.uniform(0.2, 1.5), 4); h = round(t / random.uniform(mu_s * 1.02, mu_s * 1.02 + 0.6), 3)
    args = ['rock', '--height', f'{h} m', '--thickness', f'{t} m', '--motion', '{horizontal}', '--unit', 'm/s2', '--dt', '{dt}', '--scale', f'{scale:.6g}']
    if scale_v is not None: args += ['--vertical', '{vertical}', '--vertical-scale', f'{scale_v}']
    args += ['--casters', '--rolling-resistance', f'{mu_s}'] if group == 'casters' else ['--sliding', '--friction', f'{mu_s}']
    if mu_k is not None: args += ['--friction-kinetic', f'{mu_k}']
    left = right = None
    base = solve(columns, dt, scale, scale_v, mu_s, mu_k, None, None)
    if group in ('clearance', 'casters') and base['peak']:
        far = abs(float(base['peak']))
        left, right = (float(f'{far * random.choice([0.05, 0.3, 0.9, 1.5]):.3g}') for _ in range(2))
        args += ['--clearance-left', f'{left} m', '--clearance-right', f'{right} m']
    got = expected(solve(columns, dt, scale, scale_v, mu_s, mu_k, left, right))
    more = expected(solve(columns, dt, scale * (1 + EPS), None if scale_v is None else scale_v * (1 + EPS), mu_s, mu_k, left, right))
    ampl = change(got, more)
    got['trip_speed_m_s'] = math.sqrt(8 / 3 * G * math.hypot(h, t) / 2 * (1 - h / math.hypot(h, t))) * math.hypot(h, t) / h
    sensitive = got['outcome'] != more['outcome'] or got['slide_count'] != more['slide_count'] or not ampl * EPS <= 1e-4
    times = [abs(got[k] - more[k]) / EPS for k in ('first_slide_time_s', 'clearance_time_s') if got[k] is not None and more[k] is not None]
    cases.append(dict(id=len(cases), group=group, record=record, args=args, expect=got, amplification=ampl if math.isfinite(ampl) else None,
                      time_amplification=max(times, default=0.0), sensitive=sensitive))
json.dump(dict(readme='see README.md', cases=cases), open(os.path.join(HERE, 'sliding_cases.json'), 'w'), indent=1)
print(len(cases), sum(c['sensitive'] for c in cases), 'sensitive', max(c['amplification'] or 0 for c in cases if not c['sensitive']))
