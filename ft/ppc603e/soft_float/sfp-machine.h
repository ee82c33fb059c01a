/* What soft-fp has to know of its machine, a big-endian one of 32 bits: results as the PowerPC's unit gives them, rounded to nearest, no exceptions. */
#define _FP_W_TYPE_SIZE 32
#define _FP_W_TYPE unsigned
#define _FP_WS_TYPE signed
#define _FP_I_TYPE int
#define __BYTE_ORDER 4321
#define __LITTLE_ENDIAN 1234
#define __BIG_ENDIAN 4321
typedef int CMPtype __attribute__((mode(__libgcc_cmp_return__)));

#define _FP_MUL_MEAT_S(R, X, Y) _FP_MUL_MEAT_1_wide(_FP_WFRACBITS_S, R, X, Y, umul_ppmm)
#define _FP_MUL_MEAT_D(R, X, Y) _FP_MUL_MEAT_2_wide(_FP_WFRACBITS_D, R, X, Y, umul_ppmm)
#define _FP_DIV_MEAT_S(R, X, Y) _FP_DIV_MEAT_1_udiv_norm(S, R, X, Y)
#define _FP_DIV_MEAT_D(R, X, Y) _FP_DIV_MEAT_2_udiv(D, R, X, Y)

/* The default NaN, and the first operand's payload where there is one. */
#define _FP_NANFRAC_S _FP_QNANBIT_S
#define _FP_NANFRAC_D _FP_QNANBIT_D, 0
#define _FP_NANSIGN_S 0
#define _FP_NANSIGN_D 0
#define _FP_KEEPNANFRACP 1
#define _FP_QNANNEGATEDP 0
#define _FP_TININESS_AFTER_ROUNDING 0
#define _FP_CHOOSENAN(fs, wc, R, X, Y, OP) \
  do {                                     \
    R##_s = X##_s;                         \
    _FP_FRAC_COPY_##wc(R, X);              \
    R##_c = FP_CLS_NAN;                    \
  } while (0)

#define strong_alias(name, other) extern __typeof(name) other __attribute__((alias(#name)));
