/** The fields with which the form asks for goals, from the JSON Schema of exercise files. */

/** One kind of goal that the form can ask for. */
export interface GoalField {
  readonly kind: string;
  /** The key of the goal's table that the field fills. */
  readonly key: string;
  readonly label: string;
  /** The key is the name of a membrane; else it is a number. */
  readonly membrane: boolean;
  /** The goal also names the membrane in front of the space. */
  readonly atSpace: boolean;
  readonly needsSyringe: boolean;
}

interface Property {
  readonly type?: string;
  readonly const?: string;
  readonly "x-label"?: string;
}
export interface ExerciseSchema {
  readonly properties: { readonly goal: { readonly items: { readonly oneOf: readonly { readonly $ref: string }[] } } };
  readonly $defs: Readonly<
    Record<string, { readonly properties: Readonly<Record<string, Property>>; readonly "x-syringe"?: boolean }>
  >;
}

export function goalFields({ properties, $defs }: ExerciseSchema): GoalField[] {
  return properties.goal.items.oneOf.flatMap(({ $ref }) => {
    const goal = $defs[$ref.replace("#/$defs/", "")]!;
    return Object.entries(goal.properties).flatMap(([key, { type, "x-label": label }]) =>
      label
        ? {
            kind: goal.properties.kind!.const!,
            key,
            label,
            membrane: type === "string",
            atSpace: "membrane" in goal.properties && key !== "membrane",
            needsSyringe: goal["x-syringe"] === true,
          }
        : [],
    );
  });
}
