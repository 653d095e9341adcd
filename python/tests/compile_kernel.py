"""Compiles the fused kernel for sm_80 and sm_90, which needs no card. A program: Triton must not interpret here."""

from typing import Any

import triton
from svbrdf import _kernel
from triton.backends.compiler import GPUTarget
from triton.compiler import ASTSource

kernel: Any = _kernel.loss_and_gradient
CONSTANTS = {
    **{"SCENES": 9, "GRADIENT": True, "BLOCK": 128, "T": triton.language.float32, "TINY": 1.2e-38, "MAX": 3.4e38},
    **{"EQUAL": 5e-7, "INTENSITY": 4.7, "FLOOR": 1e-3, "LIGHT_Z": 1e-3, "CLAMP": True, "EPSILON": 0.01},
    **{"D_FLOOR": 1e-3, "G_FLOOR": 1e-3},
}


def type_of(name: str) -> str:
    """The type of an argument of the kernel."""
    if name in CONSTANTS:
        return "constexpr"
    is_pointer = name in ("points", "losses", "gradient") or name.rstrip("0") in ("n", "d", "s", "r")
    return "*fp32" if is_pointer else "i32"


signature = {name: type_of(name) for name in kernel.arg_names}
if triton.__version__ < "3.2":
    # Constants have no type there.
    signature = {name: kind for name, kind in signature.items() if kind != "constexpr"}
for capability in (80, 90):
    source = ASTSource(kernel, signature, CONSTANTS)
    compiled = triton.compile(source, target=GPUTarget("cuda", capability, 32))
    assert compiled.asm["cubin"]
