"""RK4 with one step per sample in JAX, scan over the samples and vmap over the blocks, with at most one landing per step:
a graph cannot contain a loop of unknown length. Timed without its compilation, on any device that JAX finds."""

import os
import time

os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1")

import jax
import jax.numpy as jnp
from case import REST, read, write

jax.config.update("jax_enable_x64", True)


def peak(p2, alpha, tan_a, r, u, dt):
    def accel(s, y, ground):
        return -p2 * (jnp.sin(alpha - y) + s * ground * jnp.cos(alpha - y))

    def rk4(s, y, w, u0, u1, h):
        um, half = 0.5 * (u0 + u1), 0.5 * h
        k1 = accel(s, y, u0)
        w2 = w + half * k1
        k2 = accel(s, y + half * w, um)
        w3 = w + half * k2
        k3 = accel(s, y + half * w2, um)
        w4 = w + h * k3
        k4 = accel(s, y + h * w3, u1)
        return y + h / 6 * (w + 2 * w2 + 2 * w3 + w4), w + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def summit(s, y0, w0, w1, u0, u1, h):
        turns = (w0 > 0) & (w1 < 0)
        x = jnp.where(turns, w0 / jnp.where(turns, w0 - w1, 1.0), 0.0)
        ux = u0 + x * (u1 - u0)
        y, w = rk4(s, y0, w0, u0, ux, x * h)
        return jnp.where(turns, y + 0.5 * w * w / jnp.abs(accel(s, y, ux)), 0.0)

    def step(state, ground):
        y, w, s, best, moving, fallen = state
        u0, u1 = ground
        lifted_now, lifted_later = jnp.abs(u0) > tan_a, jnp.abs(u1) > tan_a
        starts = ~moving & (lifted_now | lifted_later)
        s_new = -jnp.sign(jnp.where(lifted_now, u0, u1))
        s = jnp.where(starts, s_new, s)
        later = starts & ~lifted_now
        t = jnp.where(later, (-s * tan_a - u0) / jnp.where(later, u1 - u0, 1.0), 0.0)
        moving, ua, h = moving | starts, u0 + t * (u1 - u0), (1 - t) * dt
        y1, w1 = rk4(s, y, w, ua, u1, h)
        best1 = jnp.maximum(best, jnp.maximum(y1, summit(s, y, w, w1, ua, u1, h)))
        lands = moving & ((y1 < 0) | ((y1 == 0) & (w1 < 0)))

        def newton(x, _):
            ya, wa = rk4(s, y, w, ua, ua + x * (u1 - ua), x * h)
            return jnp.clip(x - ya / (wa * h), 1e-9, 1.0), None

        x, _ = jax.lax.scan(newton, jnp.where(y > 0, y / (y - y1), 0.5), None, length=6)
        ux = ua + x * (u1 - ua)
        _, wx = rk4(s, y, w, ua, ux, x * h)
        speed, left = -wx * r, (1 - x) * h
        y2, w2 = rk4(-s, 0.0, speed, ux, u1, left)
        rests = lands & ((speed < REST) | (y2 <= 0))
        relifted = rests & lifted_later
        best2 = jnp.maximum(best1, jnp.maximum(y2, summit(-s, 0.0, speed, w2, ux, u1, left)))
        best_new = jnp.where(lands, jnp.where(rests, best1, best2), best1)
        y_new = jnp.where(lands, jnp.where(rests, 0.0, y2), y1)
        w_new = jnp.where(lands, jnp.where(rests, 0.0, w2), w1)
        s_end = jnp.where(lands, jnp.where(relifted, -jnp.sign(u1), -s), s)
        live = moving & ~fallen
        fallen = fallen | (live & (y_new >= jnp.pi / 2))
        keep = lambda new, old: jnp.where(live, new, old)
        moving = live & ~(rests & ~relifted)
        return (keep(y_new, 0.0), keep(w_new, 0.0), keep(s_end, s), keep(best_new, best), moving, fallen), None

    zero, no = jnp.zeros(()), jnp.zeros((), bool)
    (_, _, _, best, _, fallen), _ = jax.lax.scan(step, (zero, zero, zero + 1, zero, no, no), (u[:-1], u[1:]))
    return jnp.where(fallen, jnp.pi / 2, best)


dt, u, p2, alpha, tan_a, r = read()
solve = jax.jit(jax.vmap(lambda *block: peak(*block, jnp.array(u), dt)))
solve(p2, alpha, tan_a, r).block_until_ready()
start = time.perf_counter()
found = solve(p2, alpha, tan_a, r).block_until_ready()
write(time.perf_counter() - start, found)
