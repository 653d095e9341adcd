"""The rendering loss and its gradient for the prediction as one Triton kernel.

A program computes a block of texels: it loads both materials, and holds them, the loss and the gradient in registers
over all scenes. The operations and limits are those of `svbrdf.torch`; `d_x` is the derivative of the loss along `x`.
"""

import triton
import triton.language as tl


@triton.jit
def number(value: tl.constexpr, like):
    # A literal is a float32 otherwise, also beside float64.
    return tl.full((1,), value, like.dtype)


@triton.jit
def at_least(x, low: tl.constexpr):
    return tl.maximum(x, number(low, x), propagate_nan=tl.PropagateNan.ALL)


@triton.jit
def at_most(x, high: tl.constexpr):
    return tl.minimum(x, number(high, x), propagate_nan=tl.PropagateNan.ALL)


@triton.jit
def dot(ax, ay, az, bx, by, bz):
    return ax * bx + ay * by + az * bz


@triton.jit
def inverse_length(x, y, z, TINY: tl.constexpr):
    squared = dot(x, y, z, x, y, z)
    has_direction = squared >= number(TINY, x)
    return tl.where(has_direction, tl.rsqrt(tl.where(has_direction, squared, 1.0)), 0.0), has_direction


@triton.jit
def normalized(x, y, z, TINY: tl.constexpr):
    inverse, has_direction = inverse_length(x, y, z, TINY)
    return x * inverse, y * inverse, tl.where(has_direction, z * inverse, 1.0), inverse


@triton.jit
def three(map, at, channel, mask, T: tl.constexpr):
    x = tl.load(map + at, mask, 0.0).to(T)
    y = tl.load(map + at + channel, mask, 0.0).to(T)
    z = tl.load(map + at + 2 * channel, mask, 0.0).to(T)
    return x, y, z


@triton.jit
def widths(r, FLOOR: tl.constexpr):
    rough = at_least(r, FLOOR)
    a = rough * rough
    return rough, a, a * 0.5, a * a


@triton.jit
def lobe_of(nx, ny, nz, a, k, a2, n_l, n_v, hx, hy, hz, has_h,
            CLAMP: tl.constexpr, D_FLOOR: tl.constexpr, G_FLOOR: tl.constexpr):  # fmt: skip
    q = dot(nx - hx, ny - hy, nz - hz, nx - hx, ny - hy, nz - hz)
    limited = at_most(q, 2.0) if CLAMP else q
    sine2 = limited * (has_h - 0.25 * limited * has_h)
    denominator = a2 + sine2 * (1 - a2)
    d_root = a * number(0.28209479177387814, a) / at_least(denominator, D_FLOOR)  # 1 / sqrt(4 pi)
    l_denominator, v_denominator = k + at_least(n_l, 0.0) * (1 - k), k + at_least(n_v, 0.0) * (1 - k)
    g = 1 / (at_least(l_denominator, G_FLOOR) * at_least(v_denominator, G_FLOOR))
    return limited, sine2, denominator, d_root, l_denominator, v_denominator, g


@triton.jit
def compared(d, s, d0, s0, lobe, lobe0, fresnel, e, e0, EPSILON: tl.constexpr, MAX: tl.constexpr, EQUAL: tl.constexpr):
    # One channel: its loss, its reflectance, and d_radiance.
    white, white0 = fresnel * lobe, fresnel * lobe0
    reflectance = d * (1 - s) * number(0.3183098861837907, d) + white + s * (lobe - white)
    reflectance0 = d0 * (1 - s0) * number(0.3183098861837907, d) + white0 + s0 * (lobe0 - white0)
    unlimited = reflectance * e
    lifted = at_most(unlimited, MAX) + number(EPSILON, d)
    apart = tl.log(lifted) - tl.log(at_most(reflectance0 * e0, MAX) + number(EPSILON, d))
    # Rounding alone separates equal radiances by so much: they have no gradient.
    sign = tl.where(apart > number(EQUAL, d), 1.0, tl.where(apart < number(-EQUAL, d), -1.0, 0.0))
    return tl.abs(apart), reflectance, tl.where(unlimited > number(MAX, d), 0.0, sign / lifted)


@triton.jit
def loss_and_gradient(
    n, n_b, n_c, n_t, d, d_b, d_c, d_t, s, s_b, s_c, s_t, r, r_b, r_c, r_t,
    n0, n0_b, n0_c, n0_t, d0, d0_b, d0_c, d0_t, s0, s0_b, s0_c, s0_t, r0, r0_b, r0_c, r0_t,
    points, losses, gradient, texels, size, width, height, edge,
    SCENES: tl.constexpr, GRADIENT: tl.constexpr, BLOCK: tl.constexpr, T: tl.constexpr,
    TINY: tl.constexpr, MAX: tl.constexpr, EQUAL: tl.constexpr, INTENSITY: tl.constexpr, FLOOR: tl.constexpr,
    LIGHT_Z: tl.constexpr, CLAMP: tl.constexpr, D_FLOOR: tl.constexpr, G_FLOOR: tl.constexpr, EPSILON: tl.constexpr,
):  # fmt: skip
    """Maps with their strides along batch, channels and texels; points: SCENES x 7; gradient: ten maps."""
    i = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    mask = i < texels
    batch, at = (i // size).to(tl.int64), i % size
    materials = (texels // size).to(tl.int64)
    nx, ny, nz = three(n, batch * n_b + at * n_t, n_c, mask, T)
    dr, dg, db = three(d, batch * d_b + at * d_t, d_c, mask, T)
    sr, sg, sb = three(s, batch * s_b + at * s_t, s_c, mask, T)
    stored = tl.load(r + batch * r_b + at * r_t, mask, 0.0).to(T)
    nx0, ny0, nz0 = three(n0, batch * n0_b + at * n0_t, n0_c, mask, T)
    dr0, dg0, db0 = three(d0, batch * d0_b + at * d0_t, d0_c, mask, T)
    sr0, sg0, sb0 = three(s0, batch * s0_b + at * s0_t, s0_c, mask, T)
    stored0 = tl.load(r0 + batch * r0_b + at * r0_t, mask, 0.0).to(T)
    nx, ny, nz, n_inverse = normalized(nx, ny, nz, TINY)
    nx0, ny0, nz0, _ = normalized(nx0, ny0, nz0, TINY)
    rough, a, k, a2 = widths(stored, FLOOR)
    _, a0, k0, a20 = widths(stored0, FLOOR)
    x = (2 * (at % width) - (width - 1)).to(T) / edge
    y = ((height - 1) - 2 * (at // width)).to(T) / edge

    loss = tl.zeros([BLOCK], T)
    d_nx, d_ny, d_nz, d_root_a, d_a2, d_k = loss, loss, loss, loss, loss, loss
    # Sums of d_radiance e, and of the same times what multiplies specular.
    e_r, e_g, e_b, c_r, c_g, c_b = loss, loss, loss, loss, loss, loss
    for scene in range(SCENES):
        row = points + 7 * scene
        near = tl.load(row).to(T)
        lx, ly, lz = tl.load(row + 1).to(T) - near * x, tl.load(row + 2).to(T) - near * y, tl.load(row + 3).to(T)
        vx, vy, vz = tl.load(row + 4).to(T) - near * x, tl.load(row + 5).to(T) - near * y, tl.load(row + 6).to(T)
        lx, ly, lz, _ = normalized(lx, ly, lz + 0 * x, TINY)
        vx, vy, vz, _ = normalized(vx, vy, vz + 0 * x, TINY)
        h_inverse, is_h = inverse_length(lx + vx, ly + vy, lz + vz, TINY)
        hx, hy, hz = (lx + vx) * h_inverse, (ly + vy) * h_inverse, (lz + vz) * h_inverse
        has_h = tl.where(is_h, number(1.0, x), number(0.0, x))
        v_h = at_most(at_least(dot(vx, vy, vz, hx, hy, hz), 0.0), 1.0)
        fresnel = tl.exp2((number(-5.55473, x) * v_h - number(6.98316, x)) * v_h)
        irradiance = tl.where(lz > 0.0, number(INTENSITY, x) / at_least(lz, LIGHT_Z), 0.0)

        n_l0, n_v0 = dot(nx0, ny0, nz0, lx, ly, lz), dot(nx0, ny0, nz0, vx, vy, vz)
        _, _, _, d_root0, _, _, g0 = lobe_of(
            nx0, ny0, nz0, a0, k0, a20, n_l0, n_v0, hx, hy, hz, has_h, CLAMP, D_FLOOR, G_FLOOR
        )
        n_l, n_v = dot(nx, ny, nz, lx, ly, lz), dot(nx, ny, nz, vx, vy, vz)
        limited, sine2, denominator, d_root, l_denominator, v_denominator, g = lobe_of(
            nx, ny, nz, a, k, a2, n_l, n_v, hx, hy, hz, has_h, CLAMP, D_FLOOR, G_FLOOR
        )
        lobe0, lobe = (d_root0 * d_root0) * g0, (d_root * d_root) * g
        e0, e = at_least(n_l0, 0.0) * irradiance, at_least(n_l, 0.0) * irradiance
        loss_r, f_r, w_r = compared(dr, sr, dr0, sr0, lobe, lobe0, fresnel, e, e0, EPSILON, MAX, EQUAL)
        loss_g, f_g, w_g = compared(dg, sg, dg0, sg0, lobe, lobe0, fresnel, e, e0, EPSILON, MAX, EQUAL)
        loss_b, f_b, w_b = compared(db, sb, db0, sb0, lobe, lobe0, fresnel, e, e0, EPSILON, MAX, EQUAL)
        loss += loss_r + loss_g + loss_b

        if GRADIENT:
            coloured = lobe - fresnel * lobe
            e_r, e_g, e_b = e_r + w_r * e, e_g + w_g * e, e_b + w_b * e
            c_r, c_g, c_b = c_r + w_r * e * coloured, c_g + w_g * e * coloured, c_b + w_b * e * coloured
            d_lobe = (w_r + w_g + w_b) * e * fresnel + (w_r * sr + w_g * sg + w_b * sb) * e * (1 - fresnel)
            d_d = d_lobe * g * 2 * d_root
            d_root_a += d_d / at_least(denominator, D_FLOOR)
            d_denominator = -d_d * d_root / at_least(denominator, D_FLOOR)
            d_denominator = tl.where(denominator < number(D_FLOOR, x), 0.0, d_denominator)
            d_a2 += d_denominator * (1 - sine2)
            # 0 where q is limited to 2.
            d_q = d_denominator * (1 - a2) * has_h * (1 - 0.5 * limited)
            # Each factor of g is g times the denominator of the other.
            d_g = -d_lobe * (d_root * d_root) * g
            d_l = d_g * (g * at_least(v_denominator, G_FLOOR))
            d_v = d_g * (g * at_least(l_denominator, G_FLOOR))
            d_l = tl.where(l_denominator < number(G_FLOOR, x), 0.0, d_l)
            d_v = tl.where(v_denominator < number(G_FLOOR, x), 0.0, d_v)
            # d_l is 0 where n_l is below 0, since e is.
            d_k += d_l * (1 - n_l) + d_v * (1 - at_least(n_v, 0.0))
            d_n_l = (w_r * f_r + w_g * f_g + w_b * f_b) * irradiance + d_l * (1 - k)
            d_n_l = tl.where(n_l < 0.0, 0.0, d_n_l)
            d_n_v = tl.where(n_v < 0.0, 0.0, d_v * (1 - k))
            d_nx += d_n_l * lx + d_n_v * vx + 2 * d_q * (nx - hx)
            d_ny += d_n_l * ly + d_n_v * vy + 2 * d_q * (ny - hy)
            d_nz += d_n_l * lz + d_n_v * vz + 2 * d_q * (nz - hz)

    scale = 1 / (number(3.0 * SCENES, x) * texels)
    tl.store(losses + tl.program_id(0), tl.sum(tl.where(mask, loss * scale, 0.0), 0))
    if GRADIENT:
        # Each map of all materials is whole, so that autograd copies none.
        out_n, out_d = gradient + 3 * size * batch + at, gradient + 3 * size * (batch + materials) + at
        out_s, out_r = out_d + 3 * size * materials, gradient + size * (9 * materials + batch) + at
        along = dot(d_nx, d_ny, d_nz, nx, ny, nz)
        tl.store(out_n, n_inverse * (d_nx - nx * along) * scale, mask)
        tl.store(out_n + size, n_inverse * (d_ny - ny * along) * scale, mask)
        tl.store(out_n + 2 * size, n_inverse * (d_nz - nz * along) * scale, mask)
        share = number(0.3183098861837907, x) * scale
        tl.store(out_d, e_r * (1 - sr) * share, mask)
        tl.store(out_d + size, e_g * (1 - sg) * share, mask)
        tl.store(out_d + 2 * size, e_b * (1 - sb) * share, mask)
        tl.store(out_s, c_r * scale - e_r * dr * share, mask)
        tl.store(out_s + size, c_g * scale - e_g * dg * share, mask)
        tl.store(out_s + 2 * size, c_b * scale - e_b * db * share, mask)
        d_a = d_root_a * number(0.28209479177387814, x) + 2 * a * d_a2 + 0.5 * d_k
        d_r = tl.where(stored < number(FLOOR, x), 0.0, 2 * rough * d_a)
        tl.store(out_r, d_r * scale, mask)
