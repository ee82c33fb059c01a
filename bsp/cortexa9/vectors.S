/* Exception vectors. The interrupt saves what C may change and calls board_interrupt(); everything else is a fault: it is recorded as the
   processor left it, and board_fault() restarts the board. */
        .syntax unified
        .arm
        .section .text.start,"ax",%progbits
        .globl board_vectors
        .balign 32
board_vectors:
        b     fault_0
        b     fault_4                           /* no instruction */
        b     fault_8                           /* system call */
        b     fault_12                          /* code that cannot be reached */
        b     fault_16                          /* data */
        b     fault_20
        b     interrupt
        b     fault_28                          /* fast interrupt */

/* The return address and the state, with those registers that C may change, on the stack that was interrupted (32 bytes); the rest on the
   acquisition's: from the top when the background was interrupted, below what is there otherwise. Frame of 80 bytes. */
interrupt:
        sub   lr, lr, #4
        srsdb sp!, #0x13
        cpsie a, #0x13
        push  {r0-r3, r12, lr}
        ldr   r0, =board_acquisition_stack_begin
        sub   r0, sp, r0
        cmp   r0, #0x8000                       /* the stack's size */
        mov   r1, sp
        mov   r2, sp
        ldrhi r2, =board_acquisition_stack_end
        bic   r2, r2, #7
        sub   sp, r2, #80
        str   r1, [sp]
        vmrs  r2, fpscr
        str   r2, [sp, #4]
        add   r2, sp, #16
        vstmia r2, {d0-d7}
        bl    board_interrupt
        cpsid i
        add   r2, sp, #16
        vldmia r2, {d0-d7}
        ldr   r2, [sp, #4]
        vmsr  fpscr, r2
        ldr   sp, [sp]
        pop   {r0-r3, r12, lr}
        clrex
        rfeia sp!

/* Wherever it came from: return address and state on the stack of the mode for aborts; r0 is the vector, r1 how far the instruction lies
   before the return address. Without translation for that stack nothing is left to be done. */
        .macro FAULT at, arm, thumb
fault_\at:
        srsdb sp!, #0x17
        cps   #0x17
        mov   r0, #\at
        ldr   r1, [sp, #4]
        tst   r1, #0x20
        moveq r1, #\arm
        movne r1, #\thumb
        b     fault
        .endm
        FAULT 0, 0, 0
        FAULT 4, 4, 2
        FAULT 8, 4, 2
        FAULT 12, 4, 4
        FAULT 16, 8, 8
        FAULT 20, 0, 0
        FAULT 28, 4, 4

fault:  ldr   r4, =board_fault_registers
        pop   {r2, r3}
        sub   r1, r2, r1
        stmia r4!, {r0, r1, r3}
        mrc   p15, 0, r0, c6, c0, 0             /* DFAR */
        mrc   p15, 0, r1, c5, c0, 0             /* DFSR */
        mrc   p15, 0, r2, c6, c0, 2             /* IFAR */
        mrc   p15, 0, r3, c5, c0, 1             /* IFSR */
        cps   #0x13
        mov   r5, sp
        mov   r6, lr
        str   r0, [r4]
        str   r1, [r4, #4]
        str   r6, [r4, #8]
        str   r2, [r4, #12]
        str   r3, [r4, #16]
        str   r5, [r4, #20]
        mov   r0, #0
        vmsr  fpscr, r0
        mov   lr, #0
        ldr   sp, =board_fault_stack_end - 64   /* above are those of a fault in what follows */
        b     board_fault
        .ltorg
        .section .note.GNU-stack,"",%progbits
