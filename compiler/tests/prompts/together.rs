//! Prompts that are read a batch at a time.

use asperity::{learned::inference::Backend, sources::prompt::PromptCompiler};

#[test]
fn prompts_read_together_are_to_the_bit_what_they_are_alone() {
    const PROMPTS: [&str; 8] = [
        "cork",
        "felt",
        "rough ice",
        "between towel and whiteboard",
        "foam, but firmer",
        "a wooden chair covered with velvet",
        "the cold and slightly rusty railing of an iron bridge in the rain",
        "kork ☃",
    ];
    let together = PromptCompiler::embedded(&Backend::Portable).expect("the shipped model loads");
    together.read_ahead(&PROMPTS);
    for prompt in PROMPTS {
        let (one, all) = (super::PROMPTS.project(prompt), together.project(prompt));
        assert_eq!(one.expect(prompt), all.expect(prompt), "{prompt}");
        let (one, all) = (super::PROMPTS.texture(prompt), together.texture(prompt));
        assert_eq!(one.expect(prompt), all.expect(prompt), "{prompt}");
    }
}
