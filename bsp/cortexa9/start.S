/* From reset, or from the fault handler, to board_main(): caches, address translation by sections, floating point, data. */
        .syntax unified
        .arm

/* The translation table: an entry for each MB. It lies in the code's section: nothing can write to it, and the scrub watches it. Entries of
   0 are not mapped, and trap. */
        .macro MAP to, how                      /* sections up to the address, which is the next one's */
        .rept ((\to) >> 20) - ((. - board_translation) >> 2)
        .long ((. - board_translation) << 18) + (\how)
        .endr
        .endm
        .macro SKIP to
        .rept ((\to) >> 20) - ((. - board_translation) >> 2)
        .long 0
        .endr
        .endm
        .equ  CODE, 0x940E                      /* privileged: read, execute; cached, written back */
        .equ  DATA, 0x141E                      /* read, write */
        .equ  LOADED, 0x941E                    /* read */
        .equ  DEVICE, 0x0416                    /* read, write, in order, not cached */
        .section .text.start,"ax",%progbits
        .balign 16384
board_translation:
        SKIP  0x10000000
        MAP   0x10100000, DEVICE                /* serial ports, system registers */
        SKIP  0x1E000000
        MAP   0x1E100000, DEVICE                /* the processor's own: interrupt controller, timer */
        SKIP  0x60100000
        MAP   0x60200000, CODE
        SKIP  0x60400000
        MAP   0x60800000, DATA
        SKIP  0x64000000
        MAP   0x66000000, LOADED
        SKIP  0x68000000
        MAP   0x70000000, DATA
        .fill 4096 - 0x700, 4, 0

/* All lines of the data cache, by set and way (four of them); \operation: 14 writes back and empties, 6 empties. */
        .macro CACHE operation
        mov   r1, #0
        mcr   p15, 2, r1, c0, c0, 0             /* CSSELR: the first level's data */
        isb
        mrc   p15, 1, r1, c0, c0, 0             /* CCSIDR */
        ubfx  r1, r1, #13, #15                  /* the last set */
1:      mov   r2, #0
2:      orr   r3, r2, r1, lsl #5
        mcr   p15, 0, r3, c7, c\operation, 2
        adds  r2, r2, #0x40000000
        bcc   2b
        subs  r1, r1, #1
        bpl   1b
        dsb
        .endm

        .globl _start
        .type _start, %function
_start: cpsid aif, #0x13                        /* supervisor, in which all runs; no interrupts */
        setend le
        clrex
        mrc   p15, 0, r0, c1, c0, 0             /* SCTLR: the data cache is on after a restart, or as a loader leaves it: */
        tst   r0, #4
        beq   3f
        CACHE 14
3:      ldr   r4, =0x72003807                   /* TE, AFE, TRE, EE, V, I, Z, C, A, M off: as a loader left them */
        bic   r0, r0, r4
        mcr   p15, 0, r0, c1, c0, 0
        isb
        CACHE 6
        mov   r1, #0
        mcr   p15, 0, r1, c7, c5, 0             /* code's cache, branch prediction, translation: emptied */
        mcr   p15, 0, r1, c7, c5, 6
        mcr   p15, 0, r1, c8, c7, 0
        mcr   p15, 0, r1, c2, c0, 2             /* TTBCR: one table */
        ldr   r1, =board_translation
        mcr   p15, 0, r1, c2, c0, 0             /* TTBR0 */
        mov   r1, #1
        mcr   p15, 0, r1, c3, c0, 0             /* DACR: permissions hold */
        ldr   r1, =board_vectors
        mcr   p15, 0, r1, c12, c0, 0            /* VBAR */
        dsb
        isb
        ldr   r4, =0x1807                       /* I, Z, C, A, M: what is not aligned traps */
        orr   r0, r0, r4
        mcr   p15, 0, r0, c1, c0, 0
        isb
        mrc   p15, 0, r0, c1, c0, 2             /* CPACR: floating point */
        orr   r0, r0, #0x00F00000
        mcr   p15, 0, r0, c1, c0, 2
        isb
        mov   r0, #0x40000000
        vmsr  fpexc, r0
        mov   r0, #0                            /* to nearest, small numbers and what is no number as they are, no traps */
        vmsr  fpscr, r0
        cps   #0x17                             /* what faults are saved on, by whatever mode */
        ldr   sp, =board_fault_stack_end
        cps   #0x13
        ldr   sp, =board_estimation_stack_end
        mov   r11, #0                           /* the end of the chain of frames */
        mov   lr, #0
        ldr   r0, =board_data_begin             /* initial values, as the image has them */
        ldr   r1, =board_data_end
        ldr   r2, =board_data_load
4:      cmp   r0, r1
        ldrlo r3, [r2], #4
        strlo r3, [r0], #4
        blo   4b
        ldr   r0, =board_bss_begin
        ldr   r1, =board_bss_end
        mov   r2, #0
        bl    paint
        ldr   r2, =0xA5C3965A                   /* by which the most that was used is seen */
        ldr   r0, =board_estimation_stack_begin
        sub   r1, sp, #64
        bl    paint
        ldr   r0, =board_acquisition_stack_begin
        ldr   r1, =board_acquisition_stack_end
        bl    paint
        cpsie af                                /* what a device says late is a fault, too, and a fast interrupt */
        bl    board_main
5:      b     5b

paint:  cmp   r0, r1
        strlo r2, [r0], #4
        blo   paint
        bx    lr
        .ltorg
        .section .note.GNU-stack,"",%progbits
